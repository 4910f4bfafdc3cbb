// Environment light by prefiltered layers, the table's lobes, and bright texels as IBL_LAMPS lights: their number is in the text, since a
// loop that is not unrolled costs as much as ten lamps on llvmpipe.
uniform samplerCube iblIrradiance; // over pi, of the stored light
#if IBL_LAMPS > 0
uniform vec4 iblLampDirections[IBL_LAMPS]; // view space; w: what its width adds to alpha^2
uniform vec3 iblLampPowers[IBL_LAMPS];     // radiance x solid angle [sr], of the stored light
#endif

#include "vtkIBLSurface.glsl"
#include "vtkIBLLayers.glsl"
#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLSamplingFunctions.glsl"
#include "vtkIBLBRDFFunctions.glsl"

// The fitted lobe: bend, position on the ladder, and the share of irradiance that stands beside it.
vec3 iblFittedLobe(iblBoundary boundary)
{
  const vec3 mean = vec3(1.0 / 3.0);
  float share = iblDielectricShare(dot(boundary.f0, mean), dot(boundary.f90, mean), boundary.reflection.xy);
  return vec3(
    mix(boundary.lobes.xy, boundary.lobes.zw, share), mix(boundary.reflection.z, boundary.reflection.w, share));
}

// (1 - bend) N + bend R
vec3 iblLobeDirection(iblBoundary boundary, vec3 viewVC, float bend)
{
  return (1.0 + bend * (2.0 * dot(boundary.normal, viewVC) - 1.0)) * boundary.normal - bend * viewVC;
}

#ifdef IBL_PROBES
uniform samplerCubeArray iblProbeOddLayers;
uniform samplerCubeArray iblProbeEvenLayers;
uniform float iblProbeLayers; // number of the last layer

// A probe's light through the lobe at `position` on the ladder, around directionVC from `unit`. (To turn wide lobes less by parallax, as
// Lagarde & de Rousiers 2014 do, is further from the integral at any roughness.)
vec3 iblProbeReflection(iblProbe probe, vec3 unit, vec3 directionVC, float position)
{
  vec4 parallax = iblParallaxDirection(probe, unit, directionVC);
  float layer = iblLayerFromProbe(iblLayerFromPosition(position, iblProbeLayers), iblProbeLayers, parallax.w);
  iblLayerTaps taps = iblFindLayer(layer, iblProbeLayers);
  vec4 at = vec4(parallax.xyz, probe.use.x);
  vec3 even = textureLod(iblProbeEvenLayers, at, taps.even).rgb;
#ifdef IBL_MIRROR
  even = taps.isMirror ? textureLod(iblProbeRadiance, at, 0.0).rgb / probe.scale.w : even;
#endif
  return probe.scale.rgb * mix(even, textureLod(iblProbeOddLayers, at, taps.odd).rgb, taps.oddShare);
}

// Irradiance over pi: the roughest layer, which is an even one.
vec3 iblProbeIrradiance(iblProbe probe, vec3 unit, vec3 normalVC)
{
  vec4 at = vec4(iblParallaxDirection(probe, unit, normalVC).xyz, probe.use.x);
  return probe.scale.rgb * textureLod(iblProbeEvenLayers, at, 0.5 * iblProbeLayers - 1.0).rgb;
}

// In one loop, since llvmpipe takes as long for one as for a probe.
iblBoundary iblGatherProbes(iblBoundary boundary, vec3 viewVC)
{
  vec3 lobe = iblFittedLobe(boundary);
  vec3 direction = iblLobeDirection(boundary, viewVC, lobe.x);
  boundary.probeShares = vec4(0.0);
  boundary.probeIrradiance = vec3(0.0);
  boundary.probeRadiance = vec3(0.0);
  float left = 1.0;
  for (int i = 0; i < iblProbeCount; ++i)
  {
    iblProbe probe = iblGetProbe(i);
    vec3 unit = iblTransform(probe.unitFromView, vec4(boundary.position, 1.0));
    float share = left * iblProbeShare(probe, unit);
    boundary.probeShares[i] = share;
    boundary.probeIrradiance += share * iblProbeIrradiance(probe, unit, boundary.normal);
    boundary.probeRadiance += share * iblProbeReflection(probe, unit, direction, lobe.y);
    left -= share;
  }
  boundary.skyScale = left * vec3(iblRadianceScale);
  return boundary;
}
#define IBL_OF_THE_SKY boundary.skyScale *
#else
#define IBL_OF_THE_SKY
#endif

iblDiffuse iblDiffuseLight(iblBoundary boundary, vec3 viewVC)
{
  iblDiffuse light;
  light.layers = IBL_OF_THE_SKY textureLod(iblIrradiance, iblToEnvironment(boundary.normal), 0.0).rgb;
#ifdef IBL_PROBES
  light.layers += boundary.probeIrradiance;
#endif
  light.irradiance = light.layers;
#if IBL_LAMPS > 0
  vec3 lamps = vec3(0.0);
  for (int i = 0; i < IBL_LAMPS; ++i)
  {
    lamps += iblLampPowers[i] * max(dot(boundary.normal, iblLampDirections[i].xyz), 0.0);
  }
  light.irradiance += IBL_OF_THE_SKY lamps * (1.0 / iblPi);
#endif
#if IBL_ENERGY == IBL_SINGLE_SCATTER
  light.refracted = light.irradiance * (vec3(1.0) - boundary.f0 - (boundary.f90 - boundary.f0) * iblDiffuseFresnel(boundary.NoV));
#else
  light.refracted = light.irradiance;
#endif
  return light;
}

#if IBL_LAMPS > 0
// Bright texels under the boundary's exact lobe, a little wider for their size. Below the first layer's roughness they fade into the
// mirror's image, which has them, at the first layer's lobe.
vec3 iblReflectedLamps(iblBoundary boundary, vec3 viewVC)
{
  float alpha = iblAlpha(max(boundary.perceptualRoughness, IBL_FIRST_ROUGHNESS));
  float alpha2 = alpha * alpha;
  float view = iblSmithRoot(boundary.NoV, alpha2);
  float unclampedNoV = dot(boundary.normal, viewVC);
  vec3 always = vec3(0.0); // what f0 reflects, and f90 - f0 more
  vec3 grazing = vec3(0.0);
  for (int i = 0; i < IBL_LAMPS; ++i)
  {
    vec3 L = iblLampDirections[i].xyz;
    float NoL = dot(boundary.normal, L);
    float VoL1 = max(1.0 + dot(viewVC, L), 1e-6);
    float lobe = max(NoL, 0.0);
#ifdef IBL_ANISOTROPY
    if (boundary.anisotropic)
    {
      mat3 tangentFromView = transpose(mat3(boundary.tangent, boundary.bitangent, boundary.normal));
      vec2 alphas = sqrt(boundary.alpha * boundary.alpha + vec2(iblLampDirections[i].w));
      vec3 V = tangentFromView * viewVC;
      lobe *= iblD_GGXAnisotropic(tangentFromView * normalize(viewVC + L), alphas) *
        iblV_SmithGGXAnisotropic(vec3(V.xy, boundary.NoV), vec3((tangentFromView * L).xy, lobe), boundary.alpha);
    }
    else
#endif
    {
      float masking = lobe * view + boundary.NoV * iblSmithRoot(lobe, alpha2);
      lobe *= iblLobeGGX(unclampedNoV + NoL, VoL1, masking, alpha2 + iblLampDirections[i].w);
    }
#ifdef IBL_HORIZON
    lobe *= dot(boundary.geometricNormal, L) > 0.0 ? 1.0 : 0.0;
#endif
    float rise = 1.0 - sqrt(0.5 * VoL1);
    float rise2 = rise * rise;
    always += lobe * iblLampPowers[i];
    grazing += (lobe * (rise2 * rise2 * rise)) * iblLampPowers[i];
  }
  vec3 reflected = boundary.f0 * always + (boundary.f90 - boundary.f0) * grazing;
#ifdef IBL_MIRROR
  reflected *= min(boundary.perceptualRoughness / IBL_FIRST_ROUGHNESS, 1.0);
#endif
  return IBL_OF_THE_SKY reflected;
}
#endif

#ifdef IBL_ANISOTROPY
// An anisotropic lobe as isotropic ones of its narrow side in a row along the wide one, as the slopes of GGX are spread there: half
// vectors at  tan = spread u / sqrt(1 - u^2)  for even u have the marginal density of alpha = spread, and widths of GGX, with its
// long tails, add up when convolved. Each counts for what the surface reflects by it, 4 V NoL VoH / NoH of D NoH.
vec3 iblAnisotropicRadiance(iblBoundary boundary, vec3 viewVC, vec2 lobe)
{
  bool wideTangent = boundary.alpha.x > boundary.alpha.y;
  float wide = max(boundary.alpha.x, boundary.alpha.y);
  vec3 along = (wideTangent ? boundary.tangent : boundary.bitangent) * (wide - iblNarrowAlpha(boundary.alpha));
  mat3 tangentFromView = transpose(mat3(boundary.tangent, boundary.bitangent, boundary.normal));
  vec3 V = vec3((tangentFromView * viewVC).xy, boundary.NoV);
  vec3 sum = vec3(0.0);
  float weights = 1e-6;
  for (int i = 0; i < IBL_ANISOTROPIC_LOBES; ++i)
  {
    float u = (2.0 * float(i) + 1.0) / float(IBL_ANISOTROPIC_LOBES) - 1.0;
    vec3 H = normalize(boundary.normal + along * (u * inversesqrt(1.0 - u * u)));
    vec3 L = reflect(-viewVC, H);
    vec3 local = tangentFromView * L;
    float weight = local.z > 0.0 ? iblV_SmithGGXAnisotropic(V, local, boundary.alpha) * local.z *
        max(dot(viewVC, H), 0.0) / dot(H, boundary.normal) : 0.0;
    vec3 direction = mix(H, L, lobe.x);
    vec3 light = IBL_OF_THE_SKY iblLayerRadiance(iblToEnvironment(direction), iblLayerFromPosition(lobe.y, iblLayers));
#ifdef IBL_PROBES
    for (int i = 0; i < iblProbeCount; ++i)
    {
      iblProbe probe = iblGetProbe(i);
      vec3 unit = iblTransform(probe.unitFromView, vec4(boundary.position, 1.0));
      light += boundary.probeShares[i] * iblProbeReflection(probe, unit, direction, lobe.y);
    }
#endif
    sum += weight * light;
    weights += weight;
  }
  return sum / weights;
}
#endif

vec3 iblReflectedLight(iblBoundary boundary, vec3 viewVC, vec3 layers)
{
  vec3 lobe = iblFittedLobe(boundary);
  vec3 radiance;
#ifdef IBL_ANISOTROPY
  if (boundary.anisotropic)
  {
    radiance = iblAnisotropicRadiance(boundary, viewVC, lobe.xy);
  }
  else
#endif
  {
    radiance = IBL_OF_THE_SKY iblLayerRadiance(
      iblToEnvironment(iblLobeDirection(boundary, viewVC, lobe.x)), iblLayerFromPosition(lobe.y, iblLayers));
#ifdef IBL_PROBES
    radiance += boundary.probeRadiance;
#endif
  }
  radiance = boundary.once * mix(radiance, layers, lobe.z);
#ifdef IBL_HORIZON
  radiance *= iblHorizonFade(dot(reflect(-viewVC, boundary.normal), boundary.geometricNormal));
#endif
#if IBL_LAMPS > 0
  radiance += iblReflectedLamps(boundary, viewVC);
#endif
  return radiance;
}
