// All light of a cell of the sphere as one light: power is radiance x solid angle [sr]; spread is 1 - |mean of the unit directions|,
// which is the variance of direction along either tangent; width is half the edge of an even cell of that variance.
struct iblLight
{
  vec4 powerAndSpread;
  vec4 directionAndWidth;
};
