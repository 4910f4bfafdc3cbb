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

// Height-correlated Smith visibility, G / (4 NoL NoV) (Heitz 2014, eq. 99).
float iblV_SmithGGXCorrelated(float NoV, float NoL, float alpha)
{
  float a2 = alpha * alpha;
  float view = NoL * sqrt(NoV * NoV * (1.0 - a2) + a2);
  float light = NoV * sqrt(NoL * NoL * (1.0 - a2) + a2);
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

// Split sum (Karis 2013): (A, B) with  integral f(l,v) NoL dl = f0 A + f90 B  for Schlick's Fresnel term, NoV in (0,1].
// Visible half vectors: with G1 of Smith in the density, the weight is 2 NoL V (NoV + sqrt(NoV^2 (1 - alpha^2) + alpha^2)).
vec2 iblSplitSum(float NoV, float perceptualRoughness, int geometry, uint sampleCount)
{
  float alpha = max(iblAlpha(perceptualRoughness), 1e-6); // a mirror; its square is no denormal
  vec3 V = vec3(sqrt(max(1.0 - NoV * NoV, 0.0)), 0.0, NoV);
  float masking = NoV + sqrt(NoV * NoV * (1.0 - alpha * alpha) + alpha * alpha);
  vec2 sum = vec2(0.0, 0.0);
  for (uint i = 0u; i < sampleCount; ++i)
  {
    vec3 H = iblVisibleHalfVectorGGX(iblHammersley(i, sampleCount), V, alpha);
    float VoH = clamp(dot(V, H), 0.0, 1.0);
    float NoL = 2.0 * VoH * H.z - NoV;
    if (NoL > 0.0)
    {
      float visibility =
        geometry == IBL_SCHLICK_SMITH ? iblV_SchlickSmith(NoV, NoL, alpha) : iblV_SmithGGXCorrelated(NoV, NoL, alpha);
      float grazing = 1.0 - VoH;
      float grazing2 = grazing * grazing;
      float fresnel = grazing2 * grazing2 * grazing;
      float weight = 2.0 * NoL * visibility * masking;
      sum = sum + vec2(weight * (1.0 - fresnel), weight * fresnel);
    }
  }
  return sum / float(sampleCount);
}
