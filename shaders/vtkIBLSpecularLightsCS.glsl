// Radiance cube -> a coarse grid of directional lights: each cell's power, the mean direction of its light, and how far it spreads.
// Reads:  source (imageCube, binding 1, rgba32f), its size a multiple of the grid's.
// Writes: lights (std430, binding 0): [face][row][column].
// Dispatch: (size / IBL_TILE, size / IBL_TILE, 6).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
layout(binding = 1, rgba32f) readonly uniform imageCube source;
uniform int size;

#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLLight.glsl"

layout(std430, binding = 0) writeonly buffer Lights
{
  iblLight lights[];
};

void main()
{
  ivec3 cell = ivec3(gl_GlobalInvocationID);
  if (cell.x >= size || cell.y >= size)
  {
    return;
  }
  int sourceSize = imageSize(source).x;
  int ratio = sourceSize / size;
  float scale = 2.0 / float(sourceSize);
  vec3 power = vec3(0.0);
  vec3 moment = vec3(0.0);   // of direction, weighted by luminance
  vec3 geometric = vec3(0.0); // for a cell without light
  for (int j = cell.y * ratio; j < (cell.y + 1) * ratio; ++j)
  {
    for (int i = cell.x * ratio; i < (cell.x + 1) * ratio; ++i)
    {
      vec2 st = vec2(float(i), float(j)) * scale - 1.0;
      vec3 light = imageLoad(source, ivec3(i, j, cell.z)).rgb * iblCubeSolidAngle(st.x, st.y, st.x + scale, st.y + scale);
      vec3 direction = normalize(iblCubeDirection(cell.z, st.x + 0.5 * scale, st.y + 0.5 * scale));
      power += light;
      moment += dot(light, IBL_LUMINANCE) * direction;
      geometric += direction;
    }
  }
  float luminance = dot(power, IBL_LUMINANCE);
  vec3 mean = luminance > 0.0 ? moment / luminance : geometric / float(ratio * ratio);
  float concentration = length(mean);
  float spread = max(1.0 - concentration, 1e-7); // not 0: a kernel divides by its root
  lights[(cell.z * size + cell.y) * size + cell.x] =
    iblLight(vec4(power, spread), vec4(mean / concentration, sqrt(3.0 * spread)));
}
