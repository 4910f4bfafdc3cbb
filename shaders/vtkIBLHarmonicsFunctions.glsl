// Real spherical harmonics to band 2, orthonormal on the sphere, without the Condon-Shortley sign: index l (l + 1) + m, so
// that Y1 = sqrt(3 / 4 pi) (y, z, x). Ramamoorthi & Hanrahan 2001, eq. 3.

float iblHarmonic(int index, vec3 n)
{
  if (index == 0) { return 0.28209479177387814; }
  if (index == 1) { return 0.48860251190291992 * n.y; }
  if (index == 2) { return 0.48860251190291992 * n.z; }
  if (index == 3) { return 0.48860251190291992 * n.x; }
  if (index == 4) { return 1.09254843059207907 * n.x * n.y; }
  if (index == 5) { return 1.09254843059207907 * n.y * n.z; }
  if (index == 6) { return 0.31539156525252005 * (3.0 * n.z * n.z - 1.0); }
  if (index == 7) { return 1.09254843059207907 * n.x * n.z; }
  return 0.54627421529603953 * (n.x * n.x - n.y * n.y);
}

// The clamped cosine's zonal coefficients pi, 2 pi/3, pi/4: radiance coefficient times this is an irradiance coefficient.
float iblCosineLobe(int band)
{
  if (band == 0) { return iblPi; }
  if (band == 1) { return 2.0 * iblPi / 3.0; }
  return iblPi / 4.0;
}

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
