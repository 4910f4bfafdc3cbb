// Irradiance out of harmonics.

// Irradiance over pi at unit normal n from bands 0 to 2 of radiance, packed by vtkIBLPackIrradiance: red, green and blue factors of
// x, y, z and 1, the same of xy, yz, z^2 and zx, and RGB of x^2 - y^2 (Sloan 2008, Stupid Spherical Harmonics Tricks, appendix A10).
// Never negative.
vec3 iblPackedIrradiance(vec4 pack[7], vec3 n)
{
  vec4 linear = vec4(n.x, n.y, n.z, 1.0);
  vec4 square = vec4(n.x * n.y, n.y * n.z, n.z * n.z, n.z * n.x);
  vec4 rest = pack[6] * (n.x * n.x - n.y * n.y);
  float red = dot(pack[0], linear) + dot(pack[3], square) + rest.x;
  float green = dot(pack[1], linear) + dot(pack[4], square) + rest.y;
  float blue = dot(pack[2], linear) + dot(pack[5], square) + rest.z;
  return vec3(max(red, 0.0), max(green, 0.0), max(blue, 0.0));
}
