// Light at a place: that of the probes around it, laid over the sky one by one, small ones on top. Their cube maps are elements of
// arrays: mip levels of radiance, and a specular ladder as vtkIBLLayers.glsl has it. Needs GL_ARB_texture_cube_map_array.
uniform samplerCubeArray iblProbeRadiance;
uniform int iblProbeCount; // in reach of this actor
uniform vec4 iblProbeNumbers[IBL_MAXIMUM_PROBES * IBL_PROBE_NUMBERS];

#include "vtkIBLParallaxFunctions.glsl"

struct iblProbe
{
  vec4 unitFromView[3]; // rows: to where the proxy is the cube or ball of vtkIBLParallaxFunctions.glsl
  vec4 cubeFromUnit[3]; // rows: from there to what its cube map is looked up with, which has its origin in the probe
  vec4 influence; // its middle, in those coordinates; w: shape of the proxy and the influence
  vec4 influenceScale; // 1 / half its extent
  vec4 steepness; // see iblInfluence()
  vec4 scale; // from layers to the scene's light; w: from layers to radiance
  vec4 use; // element of the arrays; what it counts at most; the same of newer light of that probe, just before; its number
};

iblProbe iblGetProbe(int i)
{
  int at = i * IBL_PROBE_NUMBERS;
  return iblProbe(vec4[3](iblProbeNumbers[at], iblProbeNumbers[at + 1], iblProbeNumbers[at + 2]),
    vec4[3](iblProbeNumbers[at + 3], iblProbeNumbers[at + 4], iblProbeNumbers[at + 5]), iblProbeNumbers[at + 6],
    iblProbeNumbers[at + 7], iblProbeNumbers[at + 8], iblProbeNumbers[at + 9], iblProbeNumbers[at + 10]);
}

vec3 iblTransform(vec4 rows[3], vec4 point)
{
  return vec3(dot(rows[0], point), dot(rows[1], point), dot(rows[2], point));
}

// The probe's share of what those before it leave: all shares and what the sky gets, the rest, sum to 1. Light that fades counts as much less as the new light, before it, counts more.
float iblProbeShare(iblProbe probe, vec3 unit)
{
  float share = iblInfluence(
    (unit - probe.influence.xyz) * probe.influenceScale.xyz, probe.steepness.xyz, probe.influence.w == IBL_PROXY_BALL);
  return probe.use.y * share / max(1.0 - probe.use.z * share, 1e-6);
}

// Where the probe sees what lies in `directionVC` from a surface: direction to look it up with, and how far from the surface it is
// as against from the probe.
vec4 iblParallaxDirection(iblProbe probe, vec3 unit, vec3 directionVC)
{
  vec3 direction = iblTransform(probe.unitFromView, vec4(directionVC, 0.0));
  if (probe.influence.w == IBL_PROXY_NONE)
  {
    return vec4(iblTransform(probe.cubeFromUnit, vec4(direction, 0.0)), 1.0);
  }
  bool isBall = probe.influence.w == IBL_PROXY_BALL;
  vec3 origin = iblClampToProxy(unit, isBall);
  float exit = isBall ? iblExitOfBall(origin, direction) : iblExitOfCube(origin, direction);
  vec3 seen = iblTransform(probe.cubeFromUnit, vec4(origin + exit * direction, 1.0));
  float distance = length(iblTransform(probe.cubeFromUnit, vec4(exit * direction, 0.0)));
  return vec4(seen, distance / max(length(seen), 1e-20));
}

// What each probe counts at a place. (vtkIBLLighting.glsl works it out with the light, in one loop.)
vec4 iblProbeShares(vec3 positionVC)
{
  vec4 shares = vec4(0.0);
  float left = 1.0;
  for (int i = 0; i < iblProbeCount; ++i)
  {
    iblProbe probe = iblGetProbe(i);
    shares[i] = left * iblProbeShare(probe, iblTransform(probe.unitFromView, vec4(positionVC, 1.0)));
    left -= shares[i];
  }
  return shares;
}

#ifdef IBL_SHOW_SHARES
// Each probe's share of a place as a colour, hues a golden section apart (see vtkIBLRenderPass::SetProbeDisplay()); the sky's grey.
vec3 iblSharesAsColors(vec3 positionVC)
{
  vec4 shares = iblProbeShares(positionVC);
  vec3 color = (1.0 - dot(shares, vec4(1.0))) * vec3(0.5);
  for (int i = 0; i < iblProbeCount; ++i)
  {
    float hue = 0.381966 * iblGetProbe(i).use.w;
    color += shares[i] * (0.5 + 0.5 * cos(6.2831853 * (hue + vec3(0.0, 1.0 / 3.0, 2.0 / 3.0))));
  }
  return color;
}
#endif
