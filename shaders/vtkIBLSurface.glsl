// The surface's side of environment light, for VTK's mapper shaders (#version 150: no bindings, no compute): which boundaries reflect,
// and what becomes of the light that they let through. Every global name begins with ibl, since VTK's own text is around it.
//
// Whoever includes this says what it needs, as text costs time even where it isn't taken, and so does each number of a
// uniform: Mesa 22's llvmpipe gathers it for every pixel apart, 0.2 to 0.3 of a frame's 54 CPU-ms at 512^2.
//   IBL_ENERGY       IBL_SINGLE_SCATTER, IBL_MULTIPLE_SCATTER, IBL_CLASSIC
//   IBL_METAL, IBL_DIELECTRIC: the surface is known to be all of that
//   IBL_WHITE_EDGES: metals are known to have an f90 of 1
//   IBL_TINT: light is not scaled alike in all channels
//   IBL_PARALLEL_PROJECTION; IBL_RIGID_VIEW: view space is turned, not scaled or mirrored
//   IBL_MATT: the surface is known to reflect nothing, and is its matt base alone
//   IBL_ANISOTROPY, IBL_COAT, IBL_OCCLUSION, IBL_SPECULAR_OCCLUSION: defined or not
//   IBL_BUMPED, IBL_HORIZON_OCCLUSION: the normal is bumped, and reflections end at the unbumped surface's horizon
//   IBL_PROBES: there are local probes; all light is then scaled where it is read
// and defines iblDiffuseLight() and iblReflectedLight(), declared below.
#if defined(IBL_BUMPED) && defined(IBL_HORIZON_OCCLUSION)
#define IBL_HORIZON
#endif
#define IBL_SINGLE_SCATTER 0
#define IBL_MULTIPLE_SCATTER 1
#define IBL_CLASSIC 2

uniform sampler2D iblBRDFTable;
#ifdef IBL_RIGID_VIEW
uniform vec3 iblEnvironmentFromViewXY[2]; // a rotation's first two columns
#else
uniform mat3 iblEnvironmentFromView;
#endif
#ifdef IBL_TINT
uniform vec3 iblRadianceScale; // from the light as it is stored to the scene's: exposure, intensity, tint
#else
uniform float iblRadianceScale;
#endif

#include "vtkIBLEnergyFunctions.glsl"
#ifdef IBL_PROBES
uniform bool iblParallelProjection; // what they capture is not
#include "vtkIBLProbes.glsl"
#define IBL_OUTGOING_SCALE vec3(1.0)
#else
#define IBL_OUTGOING_SCALE iblRadianceScale
#endif

// All directions are unit vectors in view space.
struct iblMaterial
{
  vec3 normal;
  vec3 albedo; // of the matt base, and the metal's f0
  vec3 edgeTint; // the metal's f90
  float perceptualRoughness;
  float metallic; // share of the surface that is metal
  float baseF0; // of the dielectric rest
#ifdef IBL_OCCLUSION
  float occlusion; // 1: none
#endif
#ifdef IBL_HORIZON
  vec3 geometricNormal; // the unbumped one
#endif
#ifdef IBL_ANISOTROPY
  vec3 tangent;
  vec3 bitangent;
  vec2 alpha; // along these
#endif
#ifdef IBL_COAT
  vec3 coatNormal;
  vec3 coatTint; // of what passes the coat
  float coatRoughness; // perceptual
  float coatStrength;
  float coatF0;
#endif
};

// Light towards the camera, to be multiplied by IBL_OUTGOING_SCALE; and the share of even light that is reflected without
// entering the surface.
struct iblOutgoing
{
  vec3 specular;
  vec3 diffuse;
  vec3 reflectance;
};

// A boundary that reflects: the surface's, or the coat's over it.
struct iblBoundary
{
  vec3 normal;
  float NoV;
  float perceptualRoughness;
  vec3 f0;
  vec3 f90;
  vec3 once; // share of even light that it reflects once
  vec4 reflection; // the table's first block, and second
  vec4 lobes;
#ifdef IBL_PROBES
  vec3 position; // view space
  vec4 probeShares;
  vec3 skyScale; // what is left for the sky, and its scale
  vec3 probeIrradiance; // over pi
  vec3 probeRadiance; // through the boundary's lobe
#endif
#ifdef IBL_HORIZON
  vec3 geometricNormal;
#endif
#ifdef IBL_ANISOTROPY
  bool anisotropic;
  vec3 tangent;
  vec3 bitangent;
  vec2 alpha;
#endif
};

// Light on a matt base, per albedo: all of it, the part that Schlick's term lets in, and the part that layers hold, without lamps.
struct iblDiffuse
{
  vec3 irradiance; // over pi
  vec3 refracted; // over pi
  vec3 layers; // over pi
};
#ifdef IBL_PROBES
iblBoundary iblGatherProbes(iblBoundary boundary, vec3 viewVC);
#endif
iblDiffuse iblDiffuseLight(iblBoundary boundary, vec3 viewVC);
vec3 iblReflectedLight(iblBoundary boundary, vec3 viewVC, vec3 layers);

vec3 iblToEnvironment(vec3 directionVC)
{
#ifdef IBL_RIGID_VIEW
  return mat3(iblEnvironmentFromViewXY[0], iblEnvironmentFromViewXY[1],
    cross(iblEnvironmentFromViewXY[0], iblEnvironmentFromViewXY[1])) * directionVC;
#else
  return iblEnvironmentFromView * directionVC;
#endif
}

vec3 iblViewDirection(vec3 positionVC)
{
#if defined(IBL_PROBES)
  return iblParallelProjection ? vec3(0.0, 0.0, 1.0) : normalize(-positionVC);
#elif defined(IBL_PARALLEL_PROJECTION)
  return vec3(0.0, 0.0, 1.0);
#else
  return normalize(-positionVC);
#endif
}

// Below an f0 of 2 % it is no reflection but occlusion (Lagarde & de Rousiers 2014), as in VTK.
vec3 iblDielectricF90(float baseF0)
{
  return vec3(min(50.0 * baseF0, 1.0));
}

vec4 iblReadTable(float NoV, float perceptualRoughness, float block)
{
  return textureLod(
    iblBRDFTable, iblBRDFTableCoordinates(NoV, perceptualRoughness, block, float(IBL_TABLE_SIZE)), 0.0);
}

iblBoundary iblMakeBoundary(iblMaterial material, vec3 normal, vec3 positionVC, vec3 viewVC, float perceptualRoughness)
{
  iblBoundary boundary;
  boundary.normal = normal;
  boundary.NoV = clamp(dot(normal, viewVC), 1e-4, 1.0);
  boundary.perceptualRoughness = clamp(perceptualRoughness, 0.0, 1.0);
  boundary.reflection = iblReadTable(boundary.NoV, boundary.perceptualRoughness, 0.0);
  boundary.lobes = iblReadTable(boundary.NoV, boundary.perceptualRoughness, 1.0);
#ifdef IBL_PROBES
  boundary.position = positionVC;
#endif
#ifdef IBL_HORIZON
  boundary.geometricNormal = material.geometricNormal;
#endif
#ifdef IBL_ANISOTROPY
  boundary.anisotropic = false;
#endif
  return boundary;
}

// From dielectric to metal.
vec3 iblMix(vec3 dielectric, vec3 metal, float metallic)
{
#if defined(IBL_DIELECTRIC)
  return dielectric;
#elif defined(IBL_METAL)
  return metal;
#else
  return mix(dielectric, metal, metallic);
#endif
}

vec3 iblOnce(vec3 f0, vec3 f90, iblBoundary boundary)
{
#if IBL_ENERGY == IBL_CLASSIC
  return iblClassicSingleScatter(f0, f90, boundary.reflection.xy, boundary.NoV, boundary.perceptualRoughness);
#else
  return iblSingleScatter(f0, f90, boundary.reflection.xy);
#endif
}

// Environment light from a material at positionVC.
iblOutgoing iblEnvironmentLight(iblMaterial material, vec3 positionVC)
{
#ifdef IBL_WHITE_EDGES
  material.edgeTint = vec3(1.0);
#endif
  vec3 viewVC = iblViewDirection(positionVC);
  iblBoundary surface = iblMakeBoundary(material, material.normal, positionVC, viewVC, material.perceptualRoughness);
#ifdef IBL_ANISOTROPY
  surface.anisotropic = true;
  surface.tangent = material.tangent;
  surface.bitangent = material.bitangent;
  surface.alpha = material.alpha;
  // It will be put together from lobes of its narrow side.
  float narrow = sqrt(iblNarrowAlpha(material.alpha));
  surface.reflection.zw = iblReadTable(surface.NoV, narrow, 0.0).zw;
  surface.lobes = iblReadTable(surface.NoV, narrow, 1.0);
#endif
  vec3 baseF0 = vec3(material.baseF0);
  vec3 baseF90 = iblDielectricF90(material.baseF0);
  vec3 baseOnce = iblOnce(baseF0, baseF90, surface);
  vec3 metalOnce = iblOnce(material.albedo, material.edgeTint, surface);
  surface.f0 = iblMix(baseF0, material.albedo, material.metallic);
  surface.f90 = iblMix(baseF90, material.edgeTint, material.metallic);
  surface.once = iblMix(baseOnce, metalOnce, material.metallic);
#ifdef IBL_PROBES
  surface = iblGatherProbes(surface, viewVC);
#endif

  iblDiffuse light = iblDiffuseLight(surface, viewVC);
  iblOutgoing outgoing;
#ifdef IBL_MATT // f0 = f90 = 0
  outgoing.specular = vec3(0.0);
  outgoing.reflectance = vec3(0.0);
  outgoing.diffuse = material.albedo * light.irradiance;
  return outgoing;
#endif
  outgoing.reflectance = surface.once;
  outgoing.specular = iblReflectedLight(surface, viewVC, light.layers);
  // Light scattered again among facets, and what the dielectric's matt base gives back of the rest.
#if IBL_ENERGY == IBL_SINGLE_SCATTER
  outgoing.diffuse = iblMix(material.albedo, vec3(0.0), material.metallic) * light.refracted;
#else
  vec2 ab = surface.reflection.xy;
  vec3 again = iblMultipleScatter(baseF0, baseF90, baseOnce, ab);
  vec3 matt = material.albedo * max(vec3(1.0) - baseOnce - again, vec3(0.0));
  vec3 metalAgain = iblMultipleScatter(material.albedo, material.edgeTint, metalOnce, ab);
  outgoing.diffuse = light.irradiance * iblMix(again + matt, metalAgain, material.metallic);
#endif
#ifdef IBL_OCCLUSION
  outgoing.diffuse *= material.occlusion;
#ifdef IBL_SPECULAR_OCCLUSION
  outgoing.specular *= iblSpecularOcclusion(
    surface.NoV, material.occlusion, surface.perceptualRoughness * surface.perceptualRoughness);
#else
  outgoing.specular *= material.occlusion;
#endif
#endif
#ifdef IBL_COAT
  // Over it a clear coat: what it reflects, all of it dielectric, is lost to what is below, which is tinted on its way.
  iblBoundary coat = iblMakeBoundary(material, material.coatNormal, positionVC, viewVC, material.coatRoughness);
  coat.f0 = vec3(material.coatF0);
  coat.f90 = vec3(1.0);
  coat.once = iblOnce(coat.f0, coat.f90, coat);
#ifdef IBL_PROBES
  coat = iblGatherProbes(coat, viewVC);
#endif
  vec3 below = (vec3(1.0) - material.coatStrength * coat.once) * material.coatTint;
  outgoing.diffuse *= below;
  outgoing.specular = below * outgoing.specular + material.coatStrength * iblReflectedLight(coat, viewVC, light.layers);
  outgoing.reflectance = below * outgoing.reflectance + material.coatStrength * coat.once;
#endif
  return outgoing;
}
