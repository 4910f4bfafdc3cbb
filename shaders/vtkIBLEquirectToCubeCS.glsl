// Lat-long image -> radiance cube. Every texel of the cube gets the solid-angle-weighted mean of the image under it.
//
// The area under a texel is a loop integral along its four edges (Green): of C(phi, lat) dphi, with C the radiance summed up a
// column of the image to that latitude. Edges of texels are arcs of great circles, tan(lat) = A cos(phi - phi0), so the integral
// over one column is closed but for the arc's sagitta. Neighbours share their edges, so that nothing is lost or counted twice:
// energy is kept to the last digits, whatever the sizes. No mip map, no seam, and the poles are no special places.
//
// Reads:  image (sampler2D, RGB32F, row 0 = straight down).  Writes: cube (imageCube, rgba32f).
// Dispatch: (n / IBL_TILE, n / IBL_TILE, 6).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
uniform sampler2D image;
layout(binding = 0, rgba32f) writeonly uniform imageCube cube;

#include "vtkIBLDirectionFunctions.glsl"

// Solid angle is dphi dv with v = 1 + sin(latitude), from 0 at the lower pole; written so that no digits are lost there.
float height(vec3 d)
{
  float horizontal2 = d.x * d.x + d.z * d.z;
  float r = sqrt(horizontal2 + d.y * d.y);
  return d.y < 0.0 ? horizontal2 / (r * (r - d.y)) : 1.0 + d.y / r;
}

float rowHeight(int row, int rows)
{
  float s = sin(float(row) * (0.5 * iblPi / float(rows)));
  return 2.0 * s * s;
}

int rowOf(vec3 d, int rows)
{
  float colatitude = iblAngle(sqrt(d.x * d.x + d.z * d.z), -d.y);
  return clamp(int(floor(colatitude / iblPi * float(rows))), 0, rows - 1);
}

// Mean of clamp(v - low, 0, high - low) as v runs evenly from v0 to v1.
float clampedMean(float v0, float v1, float low, float high)
{
  float span = high - low;
  vec2 t = vec2(min(v0, v1), max(v0, v1)) - low;
  if (t.y - t.x < 1e-3 * span)
  {
    return clamp(0.5 * (t.x + t.y), 0.0, span);
  }
  vec2 inside = clamp(t, 0.0, span);
  vec2 integral = 0.5 * inside * inside + span * max(t - span, 0.0);
  return (integral.y - integral.x) / (t.y - t.x);
}

// Integral along the arc from a to b of radiance (xyz) and solid angle (w) between row `base` and the arc. `up` is 1, or -1 to read
// the image upside down.
vec4 arcIntegral(vec3 a, vec3 b, int base, int up, ivec2 size)
{
  vec3 normal = cross(a, b);
  float turn = iblAngle(a.x * b.z - a.z * b.x, a.x * b.x + a.z * b.z);
  bool meridian = abs(normal.y) < 1e-12 || turn == 0.0;
  if (meridian)
  {
    return vec4(0.0);
  }
  float columnScale = float(size.x) / (2.0 * iblPi);
  float start = (iblAngle(a.z, a.x) + iblPi) * columnScale;
  float end = start + turn * columnScale;
  float u0 = min(start, end);
  float u1 = max(start, end);
  vec4 sum = vec4(0.0);
  vec3 left = start < end ? a : b;
  left /= sqrt(left.x * left.x + left.z * left.z);
  // Wide columns, those of small images, are cut: an arc strays from its chord by dphi^2/8.
  float pieces = ceil(100.0 / columnScale);
  for (float from = u0; from < u1;)
  {
    float to = min(u1, (floor(from * pieces) + 1.0) / pieces);
    int column = int(floor(0.5 * (from + to)));
    column -= size.x * int(floor(float(column) / float(size.x)));
    float phi = to / columnScale - iblPi;
    vec3 right = vec3(cos(phi), 0.0, sin(phi));
    right.y = -dot(normal, right) / normal.y;
    float v0 = height(left);
    float v1 = height(right);
    int top = max(rowOf(left, size.y), rowOf(right, size.y));
    vec4 under = vec4(0.0);
    float low = rowHeight(base, size.y);
    for (int row = base; row <= top; ++row)
    {
      float high = rowHeight(row + 1, size.y);
      vec3 light = texelFetch(image, ivec2(column, up > 0 ? row : size.y - 1 - row), 0).rgb;
      under += vec4(light, 1.0) * clampedMean(v0, v1, low, high);
      low = high;
    }
    sum += under * (to - from);
    left = right;
    from = to;
  }
  return start < end ? sum : -sum;
}

void main()
{
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  int n = imageSize(cube).x;
  if (texel.x >= n || texel.y >= n)
  {
    return;
  }
  vec2 low = 2.0 * vec2(texel.xy) / float(n) - 1.0;
  vec2 high = 2.0 * vec2(texel.xy + 1) / float(n) - 1.0;
  // The upper face is read upside down, so that the pole is always below: there the integrand is 0, and a corner on the pole adds nothing.
  int up = texel.z == 2 ? -1 : 1;
  vec3 corners[4] = vec3[4](iblCubeDirection(texel.z, low.x, low.y), iblCubeDirection(texel.z, high.x, low.y),
    iblCubeDirection(texel.z, high.x, high.y), iblCubeDirection(texel.z, low.x, high.y));
  ivec2 size = textureSize(image, 0);
  int base = size.y - 1;
  for (int i = 0; i < 4; ++i)
  {
    corners[i].y *= float(up);
    base = min(base, rowOf(corners[i], size.y));
  }
  // On a side face below the equator an arc sags under its ends, by less than a row unless texels are far larger than rows.
  vec3 middle = 0.5 * (corners[0] + corners[1]);
  base = min(base, min(rowOf(middle, size.y), rowOf(0.5 * (corners[2] + corners[3]), size.y)));
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i)
  {
    sum += arcIntegral(corners[i], corners[(i + 1) % 4], base, up, size);
  }
  imageStore(cube, texel, vec4(sum.rgb / sum.a, 1.0));
}
