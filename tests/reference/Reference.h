// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause

// The project's witness: image-based lighting by plain double-precision quadrature, C++17 and std only.
// It is slow and shares no formula with the product; TestReference.cxx proves it before anyone relies on it.
//
// Conventions: world y is up. An equirectangular image has row 0 at the bottom (v = 0, y = -1), with
//   u = atan2(z, x)/(2 pi) + 1/2   (wraps),   v = asin(y)/pi + 1/2,   column = floor(u W), row = floor(v H).
// Box reading: radiance is constant over the solid angle of each texel. alpha = perceptualRoughness^2.
// Every threaded function returns the same bits whatever the number of threads.

#ifndef Reference_h
#define Reference_h

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace vtkIBLReference
{
constexpr double Pi = 3.141592653589793238462643383279502884;

struct Vec3
{
  double x, y, z;
};
inline Vec3 operator+(Vec3 a, Vec3 b) { return { a.x + b.x, a.y + b.y, a.z + b.z }; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return { a.x - b.x, a.y - b.y, a.z - b.z }; }
inline Vec3 operator*(double k, Vec3 a) { return { k * a.x, k * a.y, k * a.z }; }
inline double Dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 Cross(Vec3 a, Vec3 b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
inline Vec3 Normalize(Vec3 a) { return (1 / std::sqrt(Dot(a, a))) * a; }

using RGB = std::array<double, 3>; // linear

// ---- Environment (ReferenceEnvironment.cxx) ----------------------------------------------------------

struct Environment
{
  int width, height;
  std::vector<double> rgb; // 3 * width * height, row 0 = bottom; radiance
  const double* Texel(int row, int column) const
  {
    return this->rgb.data() + 3 * (static_cast<std::size_t>(row) * this->width + column);
  }
};

// row * width + column of the texel that holds `direction` (of any length but 0).
int TexelIndex(const Environment& environment, Vec3 direction);
// Box reading.
RGB Radiance(const Environment& environment, Vec3 direction);
// Exact solid angle of each texel of `row` [sr].
double TexelSolidAngle(const Environment& environment, int row);
// Unit direction at fractions (du, dv) in [0,1] of the texel; its centre by default.
Vec3 TexelDirection(const Environment& environment, int row, int column, double du = 0.5, double dv = 0.5);
// Integral of the unit direction over the texel [sr], closed form; divided by the solid angle, its mean.
Vec3 TexelVectorIntegral(const Environment& environment, int row, int column);

Environment ConstantEnvironment(RGB radiance, int width, int height);
// Grey L = 1 + dot(axis, direction); each texel holds the exact mean of L over its solid angle.
Environment CosineEnvironment(Vec3 axis, int width, int height);
// One texel of `radiance`, all others of `background`.
Environment OneTexelSun(
  RGB radiance, int row, int column, int width, int height, RGB background = { 0, 0, 0 });

// ---- Cube map: GL face order +X -X +Y -Y +Z -Z, GL's own s and t in [-1,1], row j = 0 at t = -1 ---------

// Unit direction.
Vec3 CubeDirection(int face, double s, double t);
// Solid angle [sr] of texel (i, j) of an n x n face, closed form.
double CubeTexelSolidAngle(int n, int i, int j);
// Solid-angle-weighted mean of the box reading over one cube texel: exact along each meridian, midpoint rule
// over `samples` meridians between any two longitudes where the column or a side of the texel changes.
// 32 against 64 moves a mean by < 3e-4 of the image's mean in noise (peak 5 means) at 256^2, 1e-6 at 8^2.
RGB CubeTexelAverage(const Environment& environment, int n, int face, int i, int j, int samples = 32);
// All 6 n^2 of them, [(face * n + j) * n + i]; threaded.
std::vector<RGB> CubeTexelAverages(const Environment& environment, int n, int samples = 32);

// ---- BRDF (ReferenceBRDF.cxx) ------------------------------------------------------------------------

// GGX distribution [1/sr]; takes sin^2 of the angle between N and H, because 1 - NoH^2 has no digits left
// at small alpha.
double D_GGX(double sinSquaredNH, double alpha);
// Height-correlated Smith visibility, already divided by 4 NoL NoV.
double V_SmithGGXCorrelated(double NoL, double NoV, double alpha);
// Schlick's Fresnel weight (1 - VoH)^5: F = f0 + (1 - f0) * weight, f90 = 1.
double SchlickWeight(double VoH);

enum class Geometry
{
  SmithCorrelated, // V_SmithGGXCorrelated
  SchlickSmith     // G1(x) = x / (x (1-k) + k), k = alpha/2 (Karis 2013, image-based lighting)
};
struct SplitSum
{
  double A, B; // reflected radiance under constant unit radiance: f0 * A + B
};
// NoV in (0,1], perceptualRoughness in [0,1]. N against 2N moves it by < 3e-6 for r >= 0.02, NoV >= 0.01.
SplitSum SplitSumAB(double NoV, double perceptualRoughness, Geometry geometry = Geometry::SmithCorrelated,
  double refinement = 1);
// A + B: the albedo of a white (f0 = 1) surface.
double DirectionalAlbedo(
  double NoV, double perceptualRoughness, Geometry geometry = Geometry::SmithCorrelated);

// GGX with alphaT along T and alphaB along B = N x T. T need not be normal to N: what is along N is taken off it.
struct Facets
{
  Vec3 N, T, B;
  double AlphaT, AlphaB;
  Facets(Vec3 normal, Vec3 tangent, double alphaT, double alphaB);
  double Q(Vec3 H) const; // 1 at N, grows with the slope
  double D(Vec3 H) const; // 1 / (pi AlphaT AlphaB Q^2) [1/sr]
  // Height-correlated Smith visibility, already divided by 4 NoL NoV.
  double Visibility(Vec3 L, Vec3 V) const;
};
// The split sum seen from V, given in the frame (T, B, N). N against 2N moves it by < 3e-6 for alphas from 4e-4 to 1
// and V.z >= 0.05.
SplitSum AnisotropicSplitSumAB(Vec3 V, double alphaT, double alphaB, double refinement = 1);

// ---- Integrals over the sphere (ReferenceIntegrals.cxx); `refinement` 2 halves every cell size -------------

// Box reading, each texel's cosine integral in closed form (16 x 16 cells where the horizon may cut it:
// 1.3e-5 relative at 32 x 16, 1.2e-8 at 1024 x 512). `normal` is a unit vector.
RGB Irradiance(const Environment& environment, Vec3 normal);
std::vector<RGB> IrradianceAll(const Environment& environment, const std::vector<Vec3>& normals);

// Real orthonormal spherical harmonics, z polar, no Condon-Shortley sign: Y_1,-1 ~ +y, Y_1,0 ~ +z,
// Y_1,1 ~ +x. Entry l (l+1) + m, l = 0..order, order <= 64.
std::vector<double> HarmonicBasis(int order, Vec3 direction);
// Coefficients of RADIANCE, integral of L Y over the sphere (no cosine, no 1/pi inside); threaded.
// Irradiance has the same coefficients times A_l = pi, 2 pi/3, pi/4, 0, -pi/24 ...
std::vector<RGB> HarmonicCoefficients(const Environment& environment, int order, double refinement = 1);

// Mean radiance under the kernel of N = V = R (derived in the source); r = 0 is the mirror, r = 1 is
// irradiance/pi. Sub-texel where the lobe is narrow. `normal` is a unit vector. N against 2N:
// < 2e-7 relative for r in [0.02, 1] and images of 32 x 16 to 1024 x 512.
RGB PrefilteredRadiance(
  const Environment& environment, Vec3 normal, double perceptualRoughness, double refinement = 1);
// The same for many directions; threaded. About 6 ms a direction and thread at 1024 x 512.
std::vector<RGB> PrefilterAll(const Environment& environment, const std::vector<Vec3>& normals,
  double perceptualRoughness, double refinement = 1);

// Radiance leaving towards V in four parts, of which that of any f0, f90 and albedo is a sum:
// F = f0 + (f90 - f0) w with Schlick's weight w = (1 - VoH)^5.
struct ReflectedParts
{
  RGB White;          // GGX, correlated Smith, F = 1
  RGB WhiteSchlick;   // the same times w
  RGB Lambert;        // irradiance / pi
  RGB LambertSchlick; // the same times w
  // GGX times F + Lambert times albedo (1 - F).
  RGB Combine(RGB f0, RGB f90, RGB diffuseAlbedo) const;
};
// Unit vectors, N.V > 0, perceptualRoughness in [0.02, 1]. N against 2N: < 6e-6 relative. About 30 ms at
// 1024 x 512.
ReflectedParts FullBRDFParts(
  const Environment& environment, Vec3 N, Vec3 V, double perceptualRoughness, double refinement = 1);
// The same for many normals seen from one V; threaded.
std::vector<ReflectedParts> FullBRDFPartsAll(const Environment& environment, const std::vector<Vec3>& normals, Vec3 V,
  double perceptualRoughness, double refinement = 1);
// The same of an anisotropic surface, alphas in [4e-4, 1].
ReflectedParts AnisotropicBRDFParts(
  const Environment& environment, const Facets& facets, Vec3 V, double refinement = 1);
// The parts put together, f90 = 1.
RGB FullBRDFRadiance(const Environment& environment, Vec3 N, Vec3 V, double perceptualRoughness, RGB f0,
  RGB diffuseAlbedo, double refinement = 1);

// A clear coat: dielectric GGX without colour, f90 = 1. It lets through what it does not reflect towards V, tinted.
struct Coat
{
  double F0, PerceptualRoughness, Strength;
  RGB Tint;
};
// s coat + (1 - s E) tint base, with `base` the radiance of what lies below, s the strength and E = F0 A + B the
// coat's albedo seen from V: a white base under a white tint is white in a furnace.
RGB CoatedRadiance(
  const Environment& environment, Vec3 N, Vec3 V, const Coat& coat, RGB base, double refinement = 1);

// ---- Threads and cache (ReferenceSupport.cxx) ------------------------------------------------------------

// 0 (default) = one thread per core.
void SetThreadCount(int count);
// body(0) .. body(count-1), each once, in any order and thread; each must write only its own slot.
void ParallelFor(int count, const std::function<void(int)>& body);

// FNV-1a, 64 bits.
std::uint64_t Hash(const void* data, std::size_t bytes, std::uint64_t seed = 14695981039346656037ull);
// Text that stands for the content in a cache key.
std::string KeyOf(const Environment& environment);
std::string KeyOf(const std::vector<Vec3>& directions);

// The vector filed under `key`, or compute()'s, then filed. Directory: environment variable
// VTKIBL_REFERENCE_CACHE, else <system temp>/vtkibl-reference. A damaged or foreign file is recomputed, a
// directory that cannot be written is ignored. The build adds a hash of these sources to the key, so that
// a changed witness never answers from old files. `key` must name every input:
//   auto sharp = Cached<RGB>("prefilter r=0.2 " + KeyOf(env) + KeyOf(normals),
//     [&] { return PrefilterAll(env, normals, 0.2); });
std::vector<double> CachedDoubles(
  const std::string& key, const std::function<std::vector<double>()>& compute);

template <class T> // T is made of doubles: double, Vec3, RGB, SplitSum
std::vector<T> Cached(const std::string& key, const std::function<std::vector<T>()>& compute)
{
  constexpr std::size_t n = sizeof(T) / sizeof(double);
  static_assert(sizeof(T) == n * sizeof(double), "T must be made of doubles");
  const std::vector<double> flat = CachedDoubles(key + "*" + std::to_string(n), [&] {
    const std::vector<T> values = compute();
    std::vector<double> doubles(values.size() * n);
    std::memcpy(doubles.data(), values.data(), values.size() * sizeof(T));
    return doubles;
  });
  std::vector<T> result(flat.size() / n);
  std::memcpy(result.data(), flat.data(), result.size() * sizeof(T));
  return result;
}
}

#endif
