// The split sum's A and B over (sqrt(NoV), perceptualRoughness), edge-aligned: the table's first block; the rest stays.
// Reads and writes: table (image2D, rgba32f).  Dispatch: (n / IBL_TILE, n / IBL_TILE, 1).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
uniform int geometry;
uniform int sampleCount;
layout(binding = 0, rgba32f) uniform image2D table;

#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLSamplingFunctions.glsl"
#include "vtkIBLBRDFFunctions.glsl"
#include "vtkIBLEnergyFunctions.glsl"

void main()
{
  ivec2 texel = ivec2(gl_GlobalInvocationID);
  if (texel.x >= IBL_TABLE_SIZE || texel.y >= IBL_TABLE_SIZE)
  {
    return;
  }
  vec2 arguments = iblBRDFTableArguments(float(texel.x), float(texel.y), float(IBL_TABLE_SIZE));
  vec2 ab = iblSplitSum(max(arguments.x, 1e-4), arguments.y, geometry, uint(sampleCount));
  imageStore(table, texel, vec4(ab, imageLoad(table, texel).zw));
}
