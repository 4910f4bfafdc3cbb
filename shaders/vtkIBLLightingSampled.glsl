// Environment light on one fragment by sampling the reflection integral: the same signature as vtkIBLLighting.glsl, converging to what that
// approximates. Visible half vectors for the specular lobe, cosine-weighted directions for the matt base, a shifted lattice a pixel.
uniform samplerCube iblRadiance; // mip levels weighted by solid angle
uniform int iblSamplesPerPixel;

#include "vtkIBLSurface.glsl"
#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLSamplingFunctions.glsl"
#include "vtkIBLBRDFFunctions.glsl"

// The environment from `direction` [environment space], at the mip level that one of so many samples of that density stands for.
vec3 iblSampleRadiance(vec3 direction, float pdf, float faceSize)
{
  float level = max(iblFilteredLod(pdf, float(iblSamplesPerPixel), faceSize), 0.0);
  return textureLod(iblRadiance, direction, level).rgb;
}

vec3 iblEnvironmentLight(
  vec3 normalVC, vec3 positionVC, vec3 albedo, float perceptualRoughness, float metallic, float baseF0, vec3 edgeTint)
{
  vec3 viewVC = iblViewDirection(positionVC);
  mat3 viewFromTangent = iblTangentFrame(normalVC);
  vec3 V = transpose(viewFromTangent) * viewVC;
  float NoV = clamp(V.z, 1e-4, 1.0);
  V = normalize(vec3(V.x, V.y, NoV));
  mat3 environmentFromTangent = iblEnvironmentFromView * viewFromTangent;
  float alpha = max(iblAlpha(perceptualRoughness), 1e-4);
  float masking = NoV + sqrt(NoV * NoV * (1.0 - alpha * alpha) + alpha * alpha);
  float faceSize = float(textureSize(iblRadiance, 0).x);
  uint shift = iblHash(uint(gl_FragCoord.x) + iblHash(uint(gl_FragCoord.y)));
  vec3 f90 = iblDielectricF90(baseF0);

  vec3 specular = vec3(0.0);
  vec3 irradiance = vec3(0.0); // over pi
  vec3 refracted = vec3(0.0);  // the share of it that enters the dielectric
  for (int i = 0; i < iblSamplesPerPixel; ++i)
  {
    vec2 u = iblLatticePoint(uint(i), shift);
    vec3 H = iblVisibleHalfVectorGGX(u, V, alpha);
    float VoH = clamp(dot(V, H), 0.0, 1.0);
    vec3 L = 2.0 * VoH * H - V;
    if (L.z > 0.0)
    {
      float pdf = iblD_GGX(H.z * H.z, H.x * H.x + H.y * H.y, alpha) / (2.0 * masking);
      vec3 fresnel = mix(iblF_Schlick(vec3(baseF0), f90, VoH), iblF_Schlick(albedo, edgeTint, VoH), metallic);
      float weight = 2.0 * L.z * iblV_SmithGGXCorrelated(NoV, L.z, alpha) * masking;
      specular += weight * fresnel * iblSampleRadiance(environmentFromTangent * L, pdf, faceSize);
    }
    float sine = sqrt(u.y);
    L = vec3(sine * cos(2.0 * iblPi * u.x), sine * sin(2.0 * iblPi * u.x), sqrt(1.0 - u.y));
    vec3 light = iblSampleRadiance(environmentFromTangent * L, L.z / iblPi, faceSize);
    irradiance += light;
    refracted += light * (vec3(1.0) - iblF_Schlick(vec3(baseF0), f90, clamp(dot(V, normalize(V + L)), 0.0, 1.0)));
  }
  // Without compensation the matt base is Lambert's, times (1 - F); with it, by the table's share, so that the furnace is white.
  vec3 matt = iblEnergyCompensation != 0
    ? iblDiffuseAlbedo(albedo, metallic, baseF0, edgeTint, iblTableAB(NoV, perceptualRoughness)) * irradiance
    : albedo * (1.0 - metallic) * refracted;
  return iblRadianceScale * (specular + matt) / float(iblSamplesPerPixel);
}
