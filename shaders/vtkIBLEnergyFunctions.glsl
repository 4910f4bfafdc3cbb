// What share of light a surface reflects: how the split sum's table is addressed, and energy out of its (A, B).

// Table coordinates in [0,1]^2 of (NoV, perceptualRoughness) in a block of the table: 0 lies below 1, both are square. sqrt(NoV)
// spends texels where A and B bend; the outer texel centres lie on the domain's edges, so that nothing is extrapolated at NoV = 0
// or roughness 1, and no block is read into the other.
vec2 iblBRDFTableCoordinates(float NoV, float perceptualRoughness, float block, float tableSize)
{
  vec2 texel = vec2(sqrt(NoV), perceptualRoughness) * (tableSize - 1.0) + vec2(0.5, 0.5 + block * tableSize);
  return texel * vec2(1.0 / tableSize, 0.5 / tableSize);
}

// The inverse at texel (i, j): (NoV, perceptualRoughness).
vec2 iblBRDFTableArguments(float i, float j, float tableSize)
{
  float root = i / (tableSize - 1.0);
  return vec2(root * root, j / (tableSize - 1.0));
}

// Share of light reflected once by the surface, and after that again among its facets (Fdez-Aguera 2019, eqs. 8 to 20; the
// mean of Schlick's F over the hemisphere is f0 + (f90 - f0)/21).
vec3 iblSingleScatter(vec3 f0, vec3 f90, vec2 ab)
{
  return f0 * ab.x + f90 * ab.y;
}

// Among facets, of light that meets a share `once` of reflection at NoV first.
vec3 iblMultipleScatter(vec3 f0, vec3 f90, vec3 once, vec2 ab)
{
  float missing = max(1.0 - (ab.x + ab.y), 0.0); // a table's values may add up to a little more than 1
  vec3 mean = f0 + (f90 - f0) * (1.0 / 21.0);
  return missing * once * mean / max(vec3(1.0, 1.0, 1.0) - missing * mean, vec3(1e-6, 1e-6, 1e-6));
}

// The classic of real-time shading (Lagarde 2011; Fdez-Aguera 2019, listing 1): Fresnel at the normal's angle, dampened by
// roughness.
vec3 iblClassicSingleScatter(vec3 f0, vec3 f90, vec2 ab, float NoV, float perceptualRoughness)
{
  float smooth1 = 1.0 - perceptualRoughness;
  float grazing = 1.0 - NoV;
  float grazing2 = grazing * grazing;
  vec3 f = f0 + (max(vec3(smooth1, smooth1, smooth1), f0) - f0) * (grazing2 * grazing2 * grazing);
  return f * ab.x + f90 * ab.y;
}

// Where between the table's lobes of a white surface (0) and of a dielectric (1) that of f0 and f90 lies: by the share of what it
// reflects that comes of Fresnel's rise, B (f90 - f0) / (f0 A + f90 B), over that of the dielectric.
float iblDielectricShare(float f0, float f90, vec2 ab)
{
  float dielectricF0 = IBL_DIELECTRIC_F0;
  float dielectric = dielectricF0 * ab.x + ab.y;
  return clamp((f90 - f0) * dielectric / max((1.0 - dielectricF0) * (f0 * ab.x + f90 * ab.y), 1e-6), 0.0, 1.0);
}

// Alpha of the isotropic lobes that IBL_ANISOTROPIC_LOBES of stand for an anisotropic one: that of its narrow side, but wide enough
// that they run into each other.
float iblNarrowAlpha(vec2 alpha)
{
  return max(min(alpha.x, alpha.y), 0.2 * max(alpha.x, alpha.y));
}

// Share of even light that Schlick's term keeps from a matt base, for f0 = 0 and f90 = 1: 1/pi Integral (1 - VoH)^5 NoL dL, to 1e-5
// of 1 (a polynomial of degree 4, fitted).
float iblDiffuseFresnel(float NoV)
{
  return (((0.00902115 * NoV - 0.04375677) * NoV + 0.08652535) * NoV - 0.07987279) * NoV + 0.02816605;
}

// What ambient occlusion, an opening's share of the cosine-weighted hemisphere, leaves of a reflection (Lagarde & de Rousiers 2014): a narrow lobe that leaves steeply is hidden less than diffuse light, a grazing one more.
float iblSpecularOcclusion(float NoV, float occlusion, float alpha)
{
  return clamp(pow(NoV + occlusion, exp2(-16.0 * alpha - 1.0)) - 1.0 + occlusion, 0.0, 1.0);
}

// What the surface's own horizon leaves of a reflection off a bumped normal: all above it, nothing from 50 degrees below (Russell
// 2015). sine is that of the reflected direction over the unbumped surface.
float iblHorizonFade(float sine)
{
  float fade = clamp(1.0 + 1.3 * sine, 0.0, 1.0);
  return fade * fade;
}
