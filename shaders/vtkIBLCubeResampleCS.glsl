// One level of a cube map from a finer one: the solid-angle-weighted mean of the texels under each texel, whole or in part. Makes
// mip levels (two to one), and a base of the wanted size out of six faces of any size.
// Reads:  source (imageCube, binding 1, rgba32f).  Writes: cube (imageCube, binding 0, rgba32f).
// Dispatch: (n / IBL_TILE, n / IBL_TILE, 6).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
layout(binding = 0, rgba32f) writeonly uniform imageCube cube;
layout(binding = 1, rgba32f) readonly uniform imageCube source;

#include "vtkIBLDirectionFunctions.glsl"

void main()
{
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  int n = imageSize(cube).x;
  if (texel.x >= n || texel.y >= n)
  {
    return;
  }
  // Edges of this texel in source texels; exact for ratios of small integers.
  int sourceSize = imageSize(source).x;
  float ratio = float(sourceSize) / float(n);
  vec2 low = vec2(texel.xy) * ratio;
  vec2 high = vec2(texel.xy + 1) * ratio;
  float scale = 2.0 / float(sourceSize);
  vec4 sum = vec4(0.0);
  for (int j = int(floor(low.y)); float(j) < high.y; ++j)
  {
    float t0 = max(low.y, float(j));
    float t1 = min(high.y, float(j + 1));
    for (int i = int(floor(low.x)); float(i) < high.x; ++i)
    {
      float s0 = max(low.x, float(i));
      float s1 = min(high.x, float(i + 1));
      float weight = iblCubeSolidAngle(s0 * scale - 1.0, t0 * scale - 1.0, s1 * scale - 1.0, t1 * scale - 1.0);
      sum += vec4(imageLoad(source, ivec3(i, j, texel.z)).rgb, 1.0) * weight;
    }
  }
  imageStore(cube, texel, vec4(sum.rgb / sum.a, 1.0));
}
