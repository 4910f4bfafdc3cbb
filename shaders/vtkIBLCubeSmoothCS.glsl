// One level of a cube map's B-spline pyramid out of the next finer: texels weighted 1 3 3 1 along each axis, across the edges of
// faces, and by solid angle. Wider than the box of mip levels, and smooth: a sample that moves sees no texel come or go.
// Reads:  source (samplerCube, seamless) at finerLevel.  Writes: cube (imageCube, binding 0, rgba32f).
// Dispatch: (n / IBL_TILE, n / IBL_TILE, 6).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
uniform samplerCube source;
uniform float finerLevel;
layout(binding = 0, rgba32f) writeonly uniform imageCube cube;

#include "vtkIBLDirectionFunctions.glsl"

void main()
{
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  int n = imageSize(cube).x;
  if (texel.x >= n || texel.y >= n)
  {
    return;
  }
  vec2 st = (2.0 * vec2(texel.xy) + 1.0) / float(n) - 1.0;
  // 3/4 of a finer texel from the centre, a linear fetch weighs two texels 3 to 1: four fetches make the sixteen.
  float offset = 0.75 / float(n);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i)
  {
    vec2 side = vec2((i & 1) == 0 ? -offset : offset, i < 2 ? -offset : offset);
    vec3 direction = iblCubeDirection(texel.z, st.x + side.x, st.y + side.y);
    vec3 unit = normalize(direction);
    float cosine = max(abs(unit.x), max(abs(unit.y), abs(unit.z)));
    sum += vec4(textureLod(source, direction, finerLevel).rgb, 1.0) * (cosine * cosine * cosine); // a texel's solid angle
  }
  imageStore(cube, texel, vec4(sum.rgb / sum.a, 1.0));
}
