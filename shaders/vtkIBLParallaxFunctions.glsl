// Where rays from inside a probe's proxy meet it, and how much a probe counts. In the proxy's own coordinates its shape is the cube
// [-1,1]^3 or the unit ball, whatever box or ellipsoid it is in the world; lengths along a ray are in units of `direction`.

// The nearest point of the proxy, for what lies outside.
vec3 iblClampToProxy(vec3 point, bool isBall)
{
  if (isBall)
  {
    return point / max(length(point), 1.0);
  }
  return clamp(point, vec3(-1.0, -1.0, -1.0), vec3(1.0, 1.0, 1.0));
}

// To where the ray leaves the cube (Kay & Kajiya 1986). Slabs that it runs along don't end it: 0/0 is no case.
float iblExitOfCube(vec3 origin, vec3 direction)
{
  float x = (1.0 - origin.x * sign(direction.x)) / max(abs(direction.x), 1e-20);
  float y = (1.0 - origin.y * sign(direction.y)) / max(abs(direction.y), 1e-20);
  float z = (1.0 - origin.z * sign(direction.z)) / max(abs(direction.z), 1e-20);
  return max(min(x, min(y, z)), 0.0);
}

// To where it leaves the unit ball: the larger root, by the form in which nothing cancels.
float iblExitOfBall(vec3 origin, vec3 direction)
{
  float a = dot(direction, direction);
  float b = dot(origin, direction);
  float c = max(1.0 - dot(origin, origin), 0.0);
  float root = sqrt(b * b + a * c);
  return b > 0.0 ? c / (b + root) : (root - b) / max(a, 1e-20);
}

// 1 well inside an influence volume, 0 at its edge and outside, without a crease in between. `point` is in the volume's own
// coordinates; steepness: along each axis, half its extent over the blend distance (of a ball: x).
float iblInfluence(vec3 point, vec3 steepness, bool isBall)
{
  vec3 inside = (vec3(1.0, 1.0, 1.0) - abs(point)) * steepness;
  float depth = isBall ? (1.0 - length(point)) * steepness.x : min(inside.x, min(inside.y, inside.z));
  float share = clamp(depth, 0.0, 1.0);
  return share * share * (3.0 - 2.0 * share);
}
