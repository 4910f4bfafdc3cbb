// Lights -> the rough layers of the specular ladder, all in one dispatch: the sum over all lights of power times GGX's kernel,
// to second order in a light's spread (docs/derivations/sampled-filter.md).
// Reads:  lights (std430, binding 0), lightCount of them; lobes[i]: k and 1 / (2 pi integral of the kernel); radianceScale.
// Writes: layers[i] (imageCube, binding i, rgba16f).
// Dispatch: (n / IBL_TILE, n / IBL_TILE, 6 x layers), n of the largest.
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
layout(binding = 0, rgba16f) writeonly uniform imageCube layers[IBL_ROUGH_LAYERS];
uniform vec2 lobes[IBL_ROUGH_LAYERS];
uniform int lightCount;
uniform float radianceScale;

#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLLight.glsl"

layout(std430, binding = 0) readonly buffer Lights
{
  iblLight lights[];
};

void main()
{
  int index = int(gl_WorkGroupID.z) / 6; // the same for a whole group, as an image's index must be
  ivec3 texel = ivec3(gl_GlobalInvocationID.xy, gl_WorkGroupID.z % 6u);
  int n = imageSize(layers[index]).x;
  if (texel.x >= n || texel.y >= n)
  {
    return;
  }
  vec2 st = (2.0 * vec2(texel.xy) + 1.0) / float(n) - 1.0;
  vec3 R = normalize(iblCubeDirection(texel.z, st.x, st.y));
  float k = lobes[index].x;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < lightCount; ++i)
  {
    // E K(t) = K(E t) + K''(E t) var(t) / 2; K = t/q^2, K'' = k (4 + 6 k t/q) / q^3, q = 1 - k t. A cell that the horizon
    // cuts, |t| < w, has the mean of max(t, 0) above that of its middle, by (w - |t|)^2 / 4w.
    vec4 light = lights[i].powerAndSpread;
    float cosine = dot(R, lights[i].directionAndWidth.xyz);
    float variance = light.w * (1.0 - cosine * cosine);
    float width = lights[i].directionAndWidth.w;
    float cut = max(width - abs(cosine), 0.0);
    float t = max(cosine * (1.0 - light.w), 0.0);
    float p = 1.0 / (1.0 - k * t);
    float curvature = cosine > 0.0 ? k * p * (2.0 + 3.0 * k * t * p) : 0.0;
    sum += p * p * (t + variance * curvature + cut * cut / (4.0 * width)) * light.rgb;
  }
  vec3 mean = sum * (lobes[index].y * radianceScale);
  imageStore(layers[index], texel, vec4(min(mean, vec3(IBL_LARGEST_HALF)), 1.0));
}
