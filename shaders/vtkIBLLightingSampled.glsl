// Environment light by sampling the reflection integral, converging to what vtkIBLLighting.glsl approximates: visible half vectors for
// what is reflected, cosine-weighted directions for the matt base, and for both the caps of the sky that hold lamps, in multiple
// importance by the balance heuristic (Veach & Guibas 1995); a shifted lattice a pixel.
uniform samplerCube iblRadiance; // mip levels weighted by solid angle
uniform int iblSamplesPerPixel;
uniform int iblFirstSample; // of those of this frame: so many had the frames before, in the same mean
#if IBL_LAMPS > 0
uniform vec4 iblLampCaps[IBL_LAMPS]; // middle, view space; 1 - cosine of the radius
#endif

#include "vtkIBLSurface.glsl"
#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLSamplingFunctions.glsl"
#include "vtkIBLBRDFFunctions.glsl"

uint iblPixelShift()
{
  return iblHash(uint(gl_FragCoord.x) + iblHash(uint(gl_FragCoord.y)));
}

// Twice as many samples go to the lamps as to the surface's own density: most of what 1024 err is theirs, since a cap is many texels,
// most of them dark.
int iblSamplesPerLamp()
{
#if IBL_LAMPS > 0
  return max(2 * iblSamplesPerPixel / IBL_LAMPS, 1);
#else
  return 0;
#endif
}

// Density of the lamps' samples in a direction, a sample of the surface's counted as 1 [1/sr].
float iblLampDensity(vec3 direction)
{
  float density = 0.0;
#if IBL_LAMPS > 0
  for (int lamp = 0; lamp < IBL_LAMPS; ++lamp)
  {
    vec4 cap = iblLampCaps[lamp];
    density += dot(direction, cap.xyz) >= 1.0 - cap.w ? 1.0 / (2.0 * iblPi * cap.w) : 0.0;
  }
  density *= float(iblSamplesPerLamp()) / float(iblSamplesPerPixel);
#endif
  return density;
}

#if IBL_LAMPS > 0
// Sample i of a lamp, evenly over its cap.
vec3 iblLampDirection(int lamp, int i, uint shift)
{
  vec4 cap = iblLampCaps[lamp];
  vec2 u = iblLatticePoint(uint(2 * iblFirstSample / IBL_LAMPS + i), iblHash(shift + uint(lamp)));
  float w = u.y * cap.w;
  float sine = sqrt(w * (2.0 - w));
  return iblTangentFrame(cap.xyz) * vec3(sine * cos(2.0 * iblPi * u.x), sine * sin(2.0 * iblPi * u.x), 1.0 - w);
}
#endif

#ifdef IBL_PROBES
iblBoundary iblGatherProbes(iblBoundary boundary, vec3 viewVC)
{
  boundary.probeShares = iblProbeShares(boundary.position);
  boundary.skyScale = (1.0 - dot(boundary.probeShares, vec4(1.0))) * vec3(iblRadianceScale);
  return boundary;
}

// Radiance from directionVC, where the sky, whose faces have so many texels, would be read at that mip level.
vec3 iblProbeSample(iblProbe probe, vec3 positionVC, vec3 directionVC, float texelsOfSky, float level)
{
  vec3 unit = iblTransform(probe.unitFromView, vec4(positionVC, 1.0));
  vec4 parallax = iblParallaxDirection(probe, unit, directionVC);
  // A cone that is narrower from the probe by this ratio covers the same patch of the proxy; texels are coarser or finer than the sky's.
  float finer = log2(float(textureSize(iblProbeRadiance, 0).x) / texelsOfSky * max(parallax.w, 1e-3));
  float at = max(level + finer, 0.0);
  return probe.scale.rgb / probe.scale.w * textureLod(iblProbeRadiance, vec4(parallax.xyz, probe.use.x), at).rgb;
}
#endif

// The environment from `direction` [view space], at the mip level that one of so many samples of that density stands for: with those of
// the frames before, so that the mean converges to the integral over the light, not over a blurred one. Beside a lamp no level reaches
// into it (1.5 texels), since what lies outside its cap is counted in full.
vec3 iblSampleRadiance(iblBoundary boundary, vec3 direction, float pdf)
{
  float faceSize = float(textureSize(iblRadiance, 0).x);
  float level = iblFilteredLod(pdf, float(iblFirstSample + iblSamplesPerPixel), faceSize);
#if IBL_LAMPS > 0
  float nearest = 2.0;
  for (int lamp = 0; lamp < IBL_LAMPS; ++lamp)
  {
    nearest = min(nearest, length(direction - iblLampCaps[lamp].xyz) - sqrt(2.0 * iblLampCaps[lamp].w));
  }
  level = min(level, log2(max(nearest * faceSize / 3.0, 1.0))); // a texel is 2 / n wide in the middle of a face
#endif
  vec3 radiance = textureLod(iblRadiance, iblToEnvironment(direction), max(level, 0.0)).rgb;
#ifdef IBL_PROBES
  radiance *= boundary.skyScale;
  for (int i = 0; i < iblProbeCount; ++i)
  {
    radiance += boundary.probeShares[i] * iblProbeSample(iblGetProbe(i), boundary.position, direction, faceSize, level);
  }
#endif
  return radiance;
}

// Adds to `light` a sample of irradiance / pi.
iblDiffuse iblAddDiffuse(iblDiffuse light, iblBoundary boundary, vec3 viewVC, vec3 L)
{
  float pdf = max(dot(boundary.normal, L), 0.0) / iblPi;
  float density = pdf + iblLampDensity(L);
  if (pdf > 0.0)
  {
    vec3 radiance = iblSampleRadiance(boundary, L, density) * (pdf / (density * float(iblSamplesPerPixel)));
    float VoH = clamp(dot(viewVC, normalize(viewVC + L)), 0.0, 1.0);
    light.irradiance += radiance;
    light.refracted += radiance * (vec3(1.0) - iblF_Schlick(boundary.f0, boundary.f90, VoH));
  }
  return light;
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
    vec2 u = iblLatticePoint(uint(iblFirstSample + i), shift);
    float sine = sqrt(u.y);
    vec3 L = viewFromTangent * vec3(sine * cos(2.0 * iblPi * u.x), sine * sin(2.0 * iblPi * u.x), sqrt(1.0 - u.y));
    light = iblAddDiffuse(light, boundary, viewVC, L);
  }
#if IBL_LAMPS > 0
  for (int i = 0; i < iblSamplesPerLamp(); ++i)
  {
    for (int lamp = 0; lamp < IBL_LAMPS; ++lamp)
    {
      light = iblAddDiffuse(light, boundary, viewVC, iblLampDirection(lamp, i, shift));
    }
  }
#endif
  return light;
}

// A sample of what is reflected, from L = directionVC at the half vector H; V, L and H in the tangent frame. visible: iblVisibleBound().
vec3 iblReflectedSample(iblBoundary boundary, vec3 V, vec3 L, vec3 H, vec3 directionVC, vec2 alpha, vec2 visible)
{
  bool seen = L.z > 0.0;
#ifdef IBL_HORIZON
  seen = seen && dot(directionVC, boundary.geometricNormal) > 0.0;
#endif
  if (!seen)
  {
    return vec3(0.0);
  }
  float pdf = iblD_GGXAnisotropic(H, alpha) / (2.0 * visible.y);
  float density = pdf + iblLampDensity(directionVC);
  float weight = 2.0 * L.z * iblV_SmithGGXAnisotropic(V, L, alpha) * visible.y * (pdf / density);
  vec3 fresnel = iblF_Schlick(boundary.f0, boundary.f90, clamp(dot(V, H), 0.0, 1.0));
  return weight * fresnel * iblSampleRadiance(boundary, directionVC, density);
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
    vec3 H = iblVisibleHalfVectorGGX(iblLatticePoint(uint(iblFirstSample + i), shift), V, alpha, visible.x);
    vec3 L = 2.0 * dot(V, H) * H - V;
    sum += iblReflectedSample(boundary, V, L, H, viewFromTangent * L, alpha, visible);
  }
#if IBL_LAMPS > 0
  for (int i = 0; i < iblSamplesPerLamp(); ++i)
  {
    for (int lamp = 0; lamp < IBL_LAMPS; ++lamp)
    {
      vec3 directionVC = iblLampDirection(lamp, i, shift);
      vec3 L = transpose(viewFromTangent) * directionVC;
      sum += iblReflectedSample(boundary, V, L, normalize(V + L), directionVC, alpha, visible);
    }
  }
#endif
  return sum / float(iblSamplesPerPixel);
}
