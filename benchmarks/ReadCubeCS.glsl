#version 450
// Reads a cube map at given directions, as a surface's shader would.
// Reads: directions (std430, binding 0, xyz), map (samplerCube).  Writes: values (std430, binding 1).  Dispatch: (n / 64, 1, 1).
layout(local_size_x = 64) in;
uniform samplerCube map;
uniform float level;
layout(std430, binding = 0) readonly buffer Directions
{
  vec4 directions[];
};
layout(std430, binding = 1) writeonly buffer Values
{
  vec4 values[];
};

void main()
{
  uint i = gl_GlobalInvocationID.x;
  if (i < directions.length())
  {
    values[i] = textureLod(map, directions[i].xyz, level);
  }
}
