// Radiance cube -> one layer of the specular ladder: the GGX lobe's mean around N = V = R, each sample weighted by NoL and read
// from the mip level that holds the solid angle it stands for (Karis 2013; Krivanek & Colbert 2008). Directions, weights and
// levels are the same for all texels but for the frame, so they come ready from the CPU, made in double.
// Reads:  source (samplerCube), samples (std430, binding 0): (direction in the tangent frame, level), weights in a second
//         array of the same length, their sum 1; radianceScale: what the stored layer is divided by.
// Writes: layer (imageCube, rgba16f).
// Dispatch: (n / IBL_TILE, n / IBL_TILE, 6).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
uniform samplerCube source;
uniform int sampleCount;
uniform float radianceScale;
layout(std430, binding = 0) readonly buffer Samples
{
  vec4 samples[];
};
layout(std430, binding = 1) readonly buffer Weights
{
  float weights[];
};
layout(binding = 0, rgba16f) writeonly uniform imageCube layer;

#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLSamplingFunctions.glsl"

void main()
{
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  int n = imageSize(layer).x;
  if (texel.x >= n || texel.y >= n)
  {
    return;
  }
  vec2 st = (2.0 * vec2(texel.xy) + 1.0) / float(n) - 1.0;
  mat3 frame = iblTangentFrame(normalize(iblCubeDirection(texel.z, st.x, st.y)));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < sampleCount; ++i)
  {
    vec4 sampled = samples[i];
    sum += weights[i] * textureLod(source, frame * sampled.xyz, sampled.w).rgb;
  }
  const float largestHalf = 65504.0;
  imageStore(layer, texel, vec4(min(sum * radianceScale, vec3(largestHalf)), 1.0));
}
