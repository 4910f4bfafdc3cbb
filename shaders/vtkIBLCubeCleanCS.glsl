// What was drawn to a cube map's faces made light: NaN and less than nothing are 0, infinity is a bound that can be summed.
// Reads and writes: cube (imageCube, binding 0, rgba32f).
// Dispatch: (n / IBL_TILE, n / IBL_TILE, 6).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
layout(binding = 0, rgba32f) uniform imageCube cube;

void main()
{
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  int n = imageSize(cube).x;
  if (texel.x >= n || texel.y >= n)
  {
    return;
  }
  vec3 light = imageLoad(cube, texel).rgb;
  bvec3 isLight = greaterThan(light, vec3(0.0)); // false for NaN
  imageStore(cube, texel, vec4(mix(vec3(0.0), min(light, vec3(IBL_LARGEST_RADIANCE)), isLight), 1.0));
}
