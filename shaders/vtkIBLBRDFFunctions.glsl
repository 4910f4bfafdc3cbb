// The reflection model: GGX, Smith, Schlick, and their split sum.

// What a user sets is perceptualRoughness in [0,1]; what formulas take is alpha (Burley 2012).
float iblAlpha(float perceptualRoughness)
{
  return perceptualRoughness * perceptualRoughness;
}

// GGX normal distribution [1/sr] from cos^2 and sin^2 of the half vector's angle (Walter et al. 2007, eq. 33).
float iblD_GGX(float cos2, float sin2, float alpha)
{
  float a2 = alpha * alpha;
  float d = cos2 * a2 + sin2;
  return a2 / (iblPi * d * d);
}

// What Smith's masking along a direction takes the root of: sqrt(cos^2 + alpha^2 sin^2).
float iblSmithRoot(float cosine, float alpha2)
{
  return sqrt(cosine * cosine * (1.0 - alpha2) + alpha2);
}

// D V without the half vector, as |V + L|^2 = 2 (1 + VoL): cosines is NoV + NoL, VoL1 is 1 + VoL, masking what
// V_SmithGGXCorrelated divides by. D may have another alpha than it.
float iblLobeGGX(float cosines, float VoL1, float masking, float alpha2)
{
  float d = 2.0 * VoL1 - cosines * cosines * (1.0 - alpha2);
  return (2.0 / iblPi) * alpha2 * VoL1 * VoL1 / (d * d * masking);
}

// Height-correlated Smith visibility, G / (4 NoL NoV) (Heitz 2014, eq. 99).
float iblV_SmithGGXCorrelated(float NoV, float NoL, float alpha)
{
  float a2 = alpha * alpha;
  return 0.5 / (NoL * iblSmithRoot(NoV, a2) + NoV * iblSmithRoot(NoL, a2));
}

// Anisotropic GGX [1/sr] of a half vector (along tangent, bitangent, normal) and alphas along the first two (Burley 2012).
// A half vector near the normal is told by its tangential parts: no digits are lost.
float iblD_GGXAnisotropic(vec3 H, vec2 alpha)
{
  vec2 slope = vec2(H.x / alpha.x, H.y / alpha.y);
  float d = slope.x * slope.x + slope.y * slope.y + H.z * H.z;
  return 1.0 / (iblPi * alpha.x * alpha.y * d * d);
}

// Its height-correlated Smith visibility; V and L likewise (Heitz 2014).
float iblV_SmithGGXAnisotropic(vec3 V, vec3 L, vec2 alpha)
{
  float view = L.z * length(vec3(alpha.x * V.x, alpha.y * V.y, V.z));
  float light = V.z * length(vec3(alpha.x * L.x, alpha.y * L.y, L.z));
  return 0.5 / (view + light);
}

// Schlick-Smith with k = alpha/2, the classic of real-time shading (Karis 2013), likewise divided by 4 NoL NoV.
float iblV_SchlickSmith(float NoV, float NoL, float alpha)
{
  float k = 0.5 * alpha;
  return 0.25 / ((NoV * (1.0 - k) + k) * (NoL * (1.0 - k) + k));
}

// Schlick's Fresnel term (Schlick 1994, eq. 24).
vec3 iblF_Schlick(vec3 f0, vec3 f90, float VoH)
{
  float grazing = 1.0 - VoH;
  float grazing2 = grazing * grazing;
  return f0 + (f90 - f0) * (grazing2 * grazing2 * grazing);
}

// Split sum (Karis 2013): (A, B) with  integral f(l,v) NoL dl = f0 A + f90 B  for Schlick's Fresnel term, NoV in (0,1], by visible
// half vectors.
vec2 iblSplitSum(float NoV, float perceptualRoughness, int geometry, uint sampleCount)
{
  float alpha = max(iblAlpha(perceptualRoughness), 1e-6); // a mirror; its square is no denormal
  vec3 V = vec3(sqrt(max(1.0 - NoV * NoV, 0.0)), 0.0, NoV);
  vec2 visible = iblVisibleBound(V, vec2(alpha, alpha));
  vec2 sum = vec2(0.0, 0.0);
  for (uint i = 0u; i < sampleCount; ++i)
  {
    vec3 H = iblVisibleHalfVectorGGX(iblHammersley(i, sampleCount), V, vec2(alpha, alpha), visible.x);
    float VoH = clamp(dot(V, H), 0.0, 1.0);
    float NoL = 2.0 * VoH * H.z - NoV;
    if (NoL > 0.0)
    {
      float visibility =
        geometry == IBL_SCHLICK_SMITH ? iblV_SchlickSmith(NoV, NoL, alpha) : iblV_SmithGGXCorrelated(NoV, NoL, alpha);
      float grazing = 1.0 - VoH;
      float grazing2 = grazing * grazing;
      float fresnel = grazing2 * grazing2 * grazing;
      float weight = 2.0 * NoL * visibility * visible.y;
      sum = sum + vec2(weight * (1.0 - fresnel), weight * fresnel);
    }
  }
  return sum / float(sampleCount);
}
