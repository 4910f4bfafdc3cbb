// Environment light on one fragment by prefiltered layers and the table, for VTK's mapper shaders (#version 150: no bindings, no
// compute). Every global name begins with ibl, since VTK's own text is around it.
uniform samplerCube iblIrradiance; // over pi, of the stored light

#include "vtkIBLSurface.glsl"
#include "vtkIBLLayers.glsl"

// Radiance towards the camera from a surface of unit normal normalVC at positionVC: `metallic` of it metal (f0 = albedo, f90 =
// edgeTint), the rest dielectric (f0 = baseF0 over a matt base of that albedo).
vec3 iblEnvironmentLight(
  vec3 normalVC, vec3 positionVC, vec3 albedo, float perceptualRoughness, float metallic, float baseF0, vec3 edgeTint)
{
  vec3 viewVC = iblViewDirection(positionVC);
  float NoV = clamp(dot(normalVC, viewVC), 1e-4, 1.0);
  vec3 specular = iblPrefilteredRadiance(iblEnvironmentFromView * reflect(-viewVC, normalVC), perceptualRoughness);
  vec3 diffuse = textureLod(iblIrradiance, iblEnvironmentFromView * normalVC, 0.0).rgb;

  vec2 ab = iblTableAB(NoV, perceptualRoughness);
  vec3 once = mix(iblSingleScatter(vec3(baseF0), iblDielectricF90(baseF0), ab), iblSingleScatter(albedo, edgeTint, ab), metallic);
  return iblRadianceScale * (once * specular + iblDiffuseAlbedo(albedo, metallic, baseF0, edgeTint, ab) * diffuse);
}
