// The split sum's A and B over (sqrt(NoV), perceptualRoughness), edge-aligned.
// Writes: table (image2D, rg16).  Dispatch: (n / IBL_TILE, n / IBL_TILE, 1).
layout(local_size_x = IBL_TILE, local_size_y = IBL_TILE) in;
uniform int geometry;
uniform int sampleCount;
layout(binding = 0, rg16) writeonly uniform image2D table;

#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLSamplingFunctions.glsl"
#include "vtkIBLBRDFFunctions.glsl"
#include "vtkIBLEnergyFunctions.glsl"

void main()
{
  ivec2 texel = ivec2(gl_GlobalInvocationID);
  int n = imageSize(table).x;
  if (texel.x >= n || texel.y >= n)
  {
    return;
  }
  vec2 arguments = iblBRDFTableArguments(float(texel.x), float(texel.y), float(n));
  imageStore(table, texel, vec4(iblSplitSum(max(arguments.x, 1e-4), arguments.y, geometry, uint(sampleCount)), 0.0, 0.0));
}
