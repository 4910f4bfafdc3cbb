// Sample points and the distributions they are warped to. A sampler states its density.

// Point i of n of the Hammersley set, centred in both: half a step keeps the spike at 0 away, and the mean unbiased. Below 1 for
// any n up to 2^23. (Bits are reversed by hand, as VTK's own shaders are of a GLSL without bitfieldReverse.)
vec2 iblHammersley(uint i, uint n)
{
  uint bits = (i << 16u) | (i >> 16u);
  bits = ((bits & 0x55555555u) << 1u) | ((bits & 0xAAAAAAAAu) >> 1u);
  bits = ((bits & 0x33333333u) << 2u) | ((bits & 0xCCCCCCCCu) >> 2u);
  bits = ((bits & 0x0F0F0F0Fu) << 4u) | ((bits & 0xF0F0F0F0u) >> 4u);
  bits = ((bits & 0x00FF00FFu) << 8u) | ((bits & 0xFF00FF00u) >> 8u);
  return vec2((float(i) + 0.5) / float(n), float(bits) * 2.3283064365386962890625e-10 + 0.5 / float(n));
}

// Scrambles an integer (Jarzynski & Olano 2020, PCG).
uint iblHash(uint value)
{
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// Point i in [0,1)^2 of a lattice that can be cut off anywhere (Roberts 2018, R2), moved around by `shift`. 24 bits, so never 1.
vec2 iblLatticePoint(uint i, uint shift)
{
  uint x = i * 3242174889u + shift;
  uint y = i * 2447445414u + iblHash(shift);
  return vec2(float(x >> 8u), float(y >> 8u)) * 5.9604644775390625e-8;
}

// cos^2 and sin^2 of the angle between normal and half vector, drawn from D_GGX(h) NoH [1/sr] (Walter et al. 2007, eq. 35).
// Both from u, so that neither is one minus the other: at alpha = 1e-3 that would leave no digits.
vec2 iblHalfVectorGGX(float u, float alpha)
{
  float a2u = alpha * alpha * u;
  float scale = 1.0 / (1.0 - u + a2u);
  return vec2((1.0 - u) * scale, a2u * scale);
}

// Of visible half vectors, those whose reflections can be above the horizon, for view direction V in the tangent frame (N = +z):
// (k, k V.z + |(alpha V.xy, V.z)|), the bound of the cap they are drawn from, and what stands for masking in their density (Eto &
// Tokuyoshi 2023).
vec2 iblVisibleBound(vec3 V, vec2 alpha)
{
  float a = min(min(alpha.x, alpha.y), 1.0);
  float s = 1.0 + sqrt(V.x * V.x + V.y * V.y);
  float a2 = a * a;
  float s2 = s * s;
  float k = (1.0 - a2) * s2 / (s2 + a2 * V.z * V.z);
  return vec2(k, k * V.z + length(vec3(alpha.x * V.x, alpha.y * V.y, V.z)));
}

// One of them, of density  D(H) / (2 masking)  in L, the direction reflected at H [1/sr], by spherical caps (Dupuy & Benyoub 2023;
// bounded: Eto & Tokuyoshi 2023, listing 1). So  f NoL / density = 2 F V NoL masking.
vec3 iblVisibleHalfVectorGGX(vec2 u, vec3 V, vec2 alpha, float bound)
{
  vec3 stretched = normalize(vec3(alpha.x * V.x, alpha.y * V.y, V.z));
  float phi = 2.0 * iblPi * u.x;
  // A cap's point has z = 1 - w; sine and the sum's z follow without a difference of near numbers.
  float w = u.y * (1.0 + bound * stretched.z);
  float sine = sqrt(max(w * (2.0 - w), 0.0));
  vec3 h = vec3(sine * cos(phi) + stretched.x, sine * sin(phi) + stretched.y,
    (1.0 - u.y) * (1.0 + bound * stretched.z) + (1.0 - bound) * stretched.z);
  return normalize(vec3(alpha.x * h.x, alpha.y * h.y, max(h.z, 1e-9)));
}

// Tangent frame with N as its third column (Duff et al. 2017): no branch at the poles but the sign.
mat3 iblTangentFrame(vec3 N)
{
  float side = N.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (side + N.z);
  float b = N.x * N.y * a;
  return mat3(vec3(1.0 + side * N.x * N.x * a, side * b, -side * N.x), vec3(b, side + N.y * N.y * a, -N.y), N);
}

// Mip level of a cube map of faceSize^2 whose texels have the solid angle that one of sampleCount samples of density pdf [1/sr]
// stands for (Colbert & Krivanek 2007, GPU Gems 3, eq. 11; texels taken as equal, 4 pi / 6 n^2). Not clamped.
float iblFilteredLod(float pdf, float sampleCount, float faceSize)
{
  return 0.5 * log2(6.0 * faceSize * faceSize / (4.0 * iblPi * sampleCount * pdf));
}
