// What share of light a surface reflects: how the split sum's table is addressed, and energy out of its (A, B).

// Table coordinates in [0,1]^2 of (NoV, perceptualRoughness). sqrt(NoV) spends texels where A and B bend; the outer texel
// centres lie on the domain's edges, so that nothing is extrapolated at NoV = 0 or roughness 1.
vec2 iblBRDFTableCoordinates(float NoV, float perceptualRoughness, float tableSize)
{
  return vec2(sqrt(NoV), perceptualRoughness) * ((tableSize - 1.0) / tableSize) + vec2(0.5 / tableSize, 0.5 / tableSize);
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

vec3 iblMultipleScatter(vec3 f0, vec3 f90, vec2 ab)
{
  float missing = 1.0 - (ab.x + ab.y);
  vec3 mean = f0 + (f90 - f0) * (1.0 / 21.0);
  return missing * iblSingleScatter(f0, f90, ab) * mean / max(vec3(1.0, 1.0, 1.0) - missing * mean, vec3(1e-6, 1e-6, 1e-6));
}
