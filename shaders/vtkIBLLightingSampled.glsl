// Environment light by sampling the reflection integral, converging to what vtkIBLLighting.glsl approximates: visible half vectors for
// what is reflected, cosine-weighted directions for the matt base, a shifted lattice a pixel.
uniform samplerCube iblRadiance; // mip levels weighted by solid angle
uniform int iblSamplesPerPixel;

#include "vtkIBLSurface.glsl"
#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLSamplingFunctions.glsl"
#include "vtkIBLBRDFFunctions.glsl"

// The environment from `direction` [view space], at the mip level that one of so many samples of that density stands for.
vec3 iblSampleRadiance(vec3 direction, float pdf)
{
  float level = max(iblFilteredLod(pdf, float(iblSamplesPerPixel), float(textureSize(iblRadiance, 0).x)), 0.0);
  return textureLod(iblRadiance, iblEnvironmentFromView * direction, level).rgb;
}

uint iblPixelShift()
{
  return iblHash(uint(gl_FragCoord.x) + iblHash(uint(gl_FragCoord.y)));
}

iblDiffuse iblDiffuseLight(iblBoundary boundary, vec3 viewVC)
{
  mat3 viewFromTangent = iblTangentFrame(boundary.normal);
  uint shift = iblPixelShift();
  iblDiffuse light;
  light.irradiance = vec3(0.0);
  light.refracted = vec3(0.0);
  light.layers = vec3(0.0);
  for (int i = 0; i < iblSamplesPerPixel; ++i)
  {
    vec2 u = iblLatticePoint(uint(i), shift);
    float sine = sqrt(u.y);
    vec3 L = viewFromTangent * vec3(sine * cos(2.0 * iblPi * u.x), sine * sin(2.0 * iblPi * u.x), sqrt(1.0 - u.y));
    vec3 radiance = iblSampleRadiance(L, sqrt(1.0 - u.y) / iblPi) / float(iblSamplesPerPixel);
    float VoH = clamp(dot(viewVC, normalize(viewVC + L)), 0.0, 1.0);
    light.irradiance += radiance;
    light.refracted += radiance * (vec3(1.0) - iblF_Schlick(boundary.f0, boundary.f90, VoH));
  }
  return light;
}

vec3 iblReflectedLight(iblBoundary boundary, vec3 viewVC, vec3 layers)
{
  mat3 viewFromTangent = iblTangentFrame(boundary.normal);
  vec2 alpha = vec2(max(iblAlpha(boundary.perceptualRoughness), 1e-4));
#ifdef IBL_ANISOTROPY
  if (boundary.anisotropic)
  {
    viewFromTangent = mat3(boundary.tangent, boundary.bitangent, boundary.normal);
    alpha = boundary.alpha;
  }
#endif
  vec3 V = transpose(viewFromTangent) * viewVC;
  V = normalize(vec3(V.xy, boundary.NoV));
  vec2 visible = iblVisibleBound(V, alpha);
  uint shift = iblPixelShift();
  vec3 sum = vec3(0.0);
  for (int i = 0; i < iblSamplesPerPixel; ++i)
  {
    vec3 H = iblVisibleHalfVectorGGX(iblLatticePoint(uint(i), shift), V, alpha, visible.x);
    float VoH = clamp(dot(V, H), 0.0, 1.0);
    vec3 L = 2.0 * VoH * H - V;
    vec3 directionVC = viewFromTangent * L;
    bool seen = L.z > 0.0;
#ifdef IBL_HORIZON
    seen = seen && dot(directionVC, boundary.geometricNormal) > 0.0;
#endif
    if (seen)
    {
      float pdf = iblD_GGXAnisotropic(H, alpha) / (2.0 * visible.y);
      float weight = 2.0 * L.z * iblV_SmithGGXAnisotropic(V, L, alpha) * visible.y;
      sum += weight * iblF_Schlick(boundary.f0, boundary.f90, VoH) * iblSampleRadiance(directionVC, pdf);
    }
  }
  return sum / float(iblSamplesPerPixel);
}
