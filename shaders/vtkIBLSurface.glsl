// What the fast and the sampled lighting share: the surface's side of the matter, and uniforms.
uniform sampler2D iblBRDFTable;
uniform mat3 iblEnvironmentFromView;
uniform vec3 iblRadianceScale; // from the light as it is stored to the scene's: exposure, intensity, tint
uniform int iblParallelProjection;
uniform int iblEnergyCompensation;

#include "vtkIBLEnergyFunctions.glsl"

vec3 iblViewDirection(vec3 positionVC)
{
  return iblParallelProjection != 0 ? vec3(0.0, 0.0, 1.0) : normalize(-positionVC);
}

vec2 iblTableAB(float NoV, float perceptualRoughness)
{
  float size = float(textureSize(iblBRDFTable, 0).x);
  return texture(iblBRDFTable, iblBRDFTableCoordinates(NoV, clamp(perceptualRoughness, 0.0, 1.0), size)).rg;
}

// Below an f0 of 2 % it is no reflection but occlusion (Lagarde & de Rousiers 2014), as in VTK.
vec3 iblDielectricF90(float baseF0)
{
  return vec3(min(50.0 * baseF0, 1.0));
}

// Factor of irradiance over pi: light scattered again among facets, and what the dielectric's matt base gives back of the rest.
vec3 iblDiffuseAlbedo(vec3 albedo, float metallic, float baseF0, vec3 edgeTint, vec2 ab)
{
  float compensation = iblEnergyCompensation != 0 ? 1.0 : 0.0;
  vec3 f90 = iblDielectricF90(baseF0);
  vec3 again = compensation * iblMultipleScatter(vec3(baseF0), f90, ab);
  vec3 matt = albedo * (vec3(1.0) - iblSingleScatter(vec3(baseF0), f90, ab) - again);
  return mix(again + matt, compensation * iblMultipleScatter(albedo, edgeTint, ab), metallic);
}
