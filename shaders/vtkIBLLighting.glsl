// Environment light on one fragment, for VTK's mapper shaders (#version 150: no bindings, no compute). Every global name
// begins with ibl, since VTK's own text is around it.
uniform sampler2D iblBRDFTable;
uniform mat3 iblEnvironmentFromView;
uniform vec3 iblIrradiance[9];   // irradiance over pi of the stored light: polynomial coefficients, see vtkIBLIrradiance
uniform vec3 iblRadianceScale;   // from stored light to the scene's: exposure, intensity, tint
uniform int iblParallelProjection;
uniform int iblEnergyCompensation;

#include "vtkIBLEnergyFunctions.glsl"
#include "vtkIBLLayers.glsl"

// Stored irradiance over pi at normal N [environment space].
vec3 iblDiffuseRadiance(vec3 N)
{
  vec3 e = iblIrradiance[0] + iblIrradiance[1] * N.y + iblIrradiance[2] * N.z + iblIrradiance[3] * N.x;
  e += iblIrradiance[4] * (N.x * N.y) + iblIrradiance[5] * (N.y * N.z) + iblIrradiance[6] * (3.0 * N.z * N.z - 1.0);
  e += iblIrradiance[7] * (N.x * N.z) + iblIrradiance[8] * (N.x * N.x - N.y * N.y);
  return max(e, vec3(0.0));
}

// Radiance towards the camera. normalVC is unit, positionVC the fragment's place; f0 and f90 as VTK made them from albedo,
// metallic, index of refraction and edge tint.
vec3 iblEnvironmentLight(vec3 normalVC, vec3 positionVC, vec3 albedo, float perceptualRoughness, float metallic, vec3 f0, vec3 f90)
{
  vec3 viewVC = iblParallelProjection != 0 ? vec3(0.0, 0.0, 1.0) : normalize(-positionVC);
  float NoV = clamp(dot(normalVC, viewVC), 1e-4, 1.0);
  vec3 reflected = iblEnvironmentFromView * reflect(-viewVC, normalVC);
  vec3 specular = iblPrefilteredRadiance(reflected, perceptualRoughness);
  vec3 diffuse = iblDiffuseRadiance(normalize(iblEnvironmentFromView * normalVC));

  float tableSize = float(textureSize(iblBRDFTable, 0).x);
  vec2 ab = texture(iblBRDFTable, iblBRDFTableCoordinates(NoV, clamp(perceptualRoughness, 0.0, 1.0), tableSize)).rg;
  vec3 once = iblSingleScatter(f0, f90, ab);
  vec3 again = iblEnergyCompensation != 0 ? iblMultipleScatter(f0, f90, ab) : vec3(0.0);
  vec3 below = albedo * (1.0 - metallic) * (vec3(1.0) - once - again);
  return iblRadianceScale * (once * specular + (again + below) * diffuse);
}
