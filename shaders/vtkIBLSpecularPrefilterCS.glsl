// Radiance cube -> one sharp layer of the specular ladder: the lobe's core by samples of equal weight, each read at the mip level
// of its solid angle (Krivanek & Colbert 2008), the rest of the lobe out of the next rougher layer. Directions and levels come ready
// from the CPU, made in double (vtkIBLSampleTable; docs/derivations/sampled-filter.md).
// Reads:  source (samplerCube), radiance; samples (std430, binding 0): direction in the tangent frame, level where it hits a
//         face's centre; tail (samplerCube): the rougher layer at tailLevel, with the weight tailWeight; radianceScale.
// Writes: layer (imageCube, binding 0, rgba16f).
// Dispatch: (n / IBL_TILE, n / IBL_TILE, 6).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
uniform samplerCube source;
uniform samplerCube tail;
uniform float tailLevel;
uniform float tailWeight;
uniform int sampleCount;
uniform float radianceScale;
layout(std430, binding = 0) readonly buffer Samples
{
  vec4 samples[];
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
  vec3 R = normalize(iblCubeDirection(texel.z, st.x, st.y));
  mat3 frame = iblTangentFrame(R);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < sampleCount; ++i)
  {
    vec3 L = frame * samples[i].xyz;
    sum += textureLod(source, L, samples[i].w + iblCubeLodOffset(L)).rgb;
  }
  vec3 core = sum * (radianceScale / float(sampleCount));
  vec3 mean = mix(core, textureLod(tail, R, tailLevel).rgb, tailWeight);
  imageStore(layer, texel, vec4(min(mean, vec3(IBL_LARGEST_HALF)), 1.0));
}
