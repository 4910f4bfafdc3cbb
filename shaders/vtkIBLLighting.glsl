// Environment light on one fragment by prefiltered layers and the table, for VTK's mapper shaders (#version 150: no bindings, no
// compute). Every global name begins with ibl, since VTK's own text is around it.
uniform vec3 iblIrradiance[9]; // irradiance over pi of the stored light: polynomial coefficients, see vtkIBLIrradiance

#include "vtkIBLSurface.glsl"
#include "vtkIBLLayers.glsl"

// Stored irradiance over pi at normal N [environment space].
vec3 iblDiffuseRadiance(vec3 N)
{
  vec3 e = iblIrradiance[0] + iblIrradiance[1] * N.y + iblIrradiance[2] * N.z + iblIrradiance[3] * N.x;
  e += iblIrradiance[4] * (N.x * N.y) + iblIrradiance[5] * (N.y * N.z) + iblIrradiance[6] * (3.0 * N.z * N.z - 1.0);
  e += iblIrradiance[7] * (N.x * N.z) + iblIrradiance[8] * (N.x * N.x - N.y * N.y);
  return max(e, vec3(0.0));
}

// Radiance towards the camera from a surface of unit normal normalVC at positionVC: `metallic` of it metal (f0 = albedo, f90 =
// edgeTint), the rest dielectric (f0 = baseF0 over a matt base of that albedo).
vec3 iblEnvironmentLight(
  vec3 normalVC, vec3 positionVC, vec3 albedo, float perceptualRoughness, float metallic, float baseF0, vec3 edgeTint)
{
  vec3 viewVC = iblViewDirection(positionVC);
  float NoV = clamp(dot(normalVC, viewVC), 1e-4, 1.0);
  vec3 specular = iblPrefilteredRadiance(iblEnvironmentFromView * reflect(-viewVC, normalVC), perceptualRoughness);
  vec3 diffuse = iblDiffuseRadiance(normalize(iblEnvironmentFromView * normalVC));

  vec2 ab = iblTableAB(NoV, perceptualRoughness);
  vec3 once = mix(iblSingleScatter(vec3(baseF0), iblDielectricF90(baseF0), ab), iblSingleScatter(albedo, edgeTint, ab), metallic);
  return iblRadianceScale * (once * specular + iblDiffuseAlbedo(albedo, metallic, baseF0, edgeTint, ab) * diffuse);
}
