// Radiance cube -> nine harmonic coefficients of each row of each face; the rows are added in double on the CPU, because a
// running single-precision sum over a large map is off by percents.
// Reads:  source (imageCube, binding 1, rgba32f).
// Writes: rows (std430, binding 0): vec4 [face][row][9], rgb = sum over the row of radiance Y_i dOmega.
// Dispatch: (n, 6, 1), one group a row.
layout(local_size_x = IBL_ROW_THREADS) in;
layout(binding = 1, rgba32f) readonly uniform imageCube source;
layout(std430, binding = 0) writeonly buffer Rows
{
  vec4 rows[];
};

#include "vtkIBLDirectionFunctions.glsl"
#include "vtkIBLHarmonicsFunctions.glsl"

shared vec3 partial[IBL_ROW_THREADS][9];

void main()
{
  int row = int(gl_WorkGroupID.x);
  int face = int(gl_WorkGroupID.y);
  int thread = int(gl_LocalInvocationID.x);
  int size = imageSize(source).x;
  float scale = 2.0 / float(size);
  vec3 sums[9];
  for (int k = 0; k < 9; ++k)
  {
    sums[k] = vec3(0.0);
  }
  for (int column = thread; column < size; column += IBL_ROW_THREADS)
  {
    float s0 = float(column) * scale - 1.0;
    float t0 = float(row) * scale - 1.0;
    vec3 direction = normalize(iblCubeDirection(face, s0 + 0.5 * scale, t0 + 0.5 * scale));
    vec3 light = imageLoad(source, ivec3(column, row, face)).rgb * iblCubeSolidAngle(s0, t0, s0 + scale, t0 + scale);
    for (int k = 0; k < 9; ++k)
    {
      sums[k] += light * iblHarmonic(k, direction);
    }
  }
  for (int k = 0; k < 9; ++k)
  {
    partial[thread][k] = sums[k];
  }
  barrier();
  if (thread < 9)
  {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < IBL_ROW_THREADS; ++i)
    {
      sum += partial[i][thread];
    }
    rows[(face * size + row) * 9 + thread] = vec4(sum, 0.0);
  }
}
