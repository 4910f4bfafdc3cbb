// Directions, cube faces and lat-long coordinates: the only place where an axis is flipped (docs/conventions.md).

const float iblPi = 3.14159265358979323846;

// Angle of (x, y) in (-pi, pi], to the last digits in single and in double precision; 0 for (0, 0). OpenGL asks only 4096 units in the
// last place of its atan, and Mesa's is off by 1e-5: there a bright texel on a texel's edge gains or loses percents.
// Reduced to |ratio| <= 0.66, then the rational approximation of Moshier 1989, Methods and Programs for Mathematical Functions.
float iblAngle(float y, float x)
{
  float ax = abs(x);
  float ay = abs(y);
  float least = min(ax, ay);
  float most = max(ax, ay);
  if (most == 0.0) { return 0.0; }
  bool nearDiagonal = least > 0.66 * most;
  float ratio = nearDiagonal ? (least - most) / (least + most) : least / most;
  float z = ratio * ratio;
  float p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
    1.228866684490136173410e2) * z - 6.485021904942025371773e1;
  float q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z +
    4.853903996359136964868e2) * z + 1.945506571482613964425e2;
  float angle = ratio + ratio * z * p / q;
  angle = nearDiagonal ? angle + 0.25 * iblPi : angle;
  angle = ay > ax ? 0.5 * iblPi - angle : angle;
  angle = x < 0.0 ? iblPi - angle : angle;
  return y < 0.0 ? -angle : angle;
}

// Direction through (s, t) in [-1,1]^2 of a face in GL order +X -X +Y -Y +Z -Z (OpenGL 4.5 core, table 8.19, solved for the
// direction). Not normalised: it ends on the face, at distance 1 from the centre along the major axis.
vec3 iblCubeDirection(int face, float s, float t)
{
  if (face == 0) { return vec3(1.0, -t, -s); }
  if (face == 1) { return vec3(-1.0, -t, s); }
  if (face == 2) { return vec3(s, 1.0, t); }
  if (face == 3) { return vec3(s, -1.0, -t); }
  if (face == 4) { return vec3(s, -t, 1.0); }
  return vec3(-s, -t, -1.0);
}

// Lat-long coordinates (u, v) in [0,1]^2 of a unit direction: u = atan(z, x)/2pi + 1/2, v = asin(y)/pi + 1/2, as VTK has it.
// asin as the angle of both legs: no digits are lost near the poles, and |y| = 1 + epsilon is no NaN.
vec2 iblEquirectFromDirection(vec3 direction)
{
  float horizontal = sqrt(direction.x * direction.x + direction.z * direction.z);
  return vec2(
    iblAngle(direction.z, direction.x) * (0.5 / iblPi) + 0.5, iblAngle(direction.y, horizontal) / iblPi + 0.5);
}

// The inverse: a unit direction.
vec3 iblDirectionFromEquirect(float u, float v)
{
  float longitude = (u - 0.5) * (2.0 * iblPi);
  float latitude = (v - 0.5) * iblPi;
  return vec3(cos(latitude) * cos(longitude), sin(latitude), cos(latitude) * sin(longitude));
}

// Solid angle [sr] of the triangle a b c on the plane at distance 1, given the triple product a.(b x c): Van Oosterom &
// Strackee 1983, eq. 8. On that plane the triple product is twice the triangle's area, so nothing cancels.
float iblTriangleSolidAngle(vec3 a, vec3 b, vec3 c, float tripleProduct)
{
  float la = length(a);
  float lb = length(b);
  float lc = length(c);
  return 2.0 * iblAngle(tripleProduct, la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
}

// Exact solid angle [sr] of the rectangle [s0,s1] x [t0,t1] of a cube face. (The usual difference of four atan(s t / r) loses
// 1 % at 256^2 in single precision; this keeps 1e-6 at any size.)
float iblCubeSolidAngle(float s0, float t0, float s1, float t1)
{
  vec3 a = vec3(s0, t0, 1.0);
  vec3 b = vec3(s1, t0, 1.0);
  vec3 c = vec3(s1, t1, 1.0);
  vec3 d = vec3(s0, t1, 1.0);
  float twiceArea = (s1 - s0) * (t1 - t0);
  return iblTriangleSolidAngle(a, b, c, twiceArea) + iblTriangleSolidAngle(a, c, d, twiceArea);
}

// Mip levels to add where a unit direction hits a face off its centre, because texels there have a smaller solid angle, cos^3 of
// that at the centre (cos = the largest component): -3/2 log2(cos), to 0.02, as a polynomial of sin^2.
float iblCubeLodOffset(vec3 direction)
{
  float cosine = max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
  float sine2 = 1.0 - cosine * cosine;
  return sine2 * (0.85 + 1.36 * sine2);
}
