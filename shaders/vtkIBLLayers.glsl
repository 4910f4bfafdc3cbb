// Reads the specular ladder: odd layers are the mip levels of one cube map, even ones those of another.
// IBL_MIRROR: whoever includes this may ask for a roughness below that of layer 1. Without it the mirror's cube is not there: a driver
// that runs both sides of a branch would read it.
#ifdef IBL_MIRROR
uniform samplerCube iblRadiance;
#endif
uniform samplerCube iblOddLayers;
uniform samplerCube iblEvenLayers;
uniform float iblLayers;      // number of the last layer
uniform float iblStoredScale; // what layers are divided by, and the radiance cube is not

#include "vtkIBLLadderFunctions.glsl"

// Where a layer, or what lies between two, is read: mip levels of both cubes, and the share of the odd ones.
struct iblLayerTaps
{
  float even;
  float odd;
  float oddShare;
  bool isMirror; // what stands for the even layer is the mirror
};

iblLayerTaps iblFindLayer(float at, float layers)
{
#ifdef IBL_MIRROR
  const float sharpest = 0.0;
#else
  const float sharpest = 1.0;
#endif
  float layer = clamp(at, sharpest, layers);
  float below = min(floor(layer), layers - 1.0);
  float share = layer - below;
  float level = floor(0.5 * below);
  bool belowIsEven = 2.0 * level == below;
  return iblLayerTaps(max(belowIsEven ? level - 1.0 : level, 0.0), level, belowIsEven ? share : 1.0 - share, below == 0.0);
}

// Stored light from direction [environment space] at a layer, or between two.
vec3 iblLayerRadiance(vec3 direction, float at)
{
  iblLayerTaps taps = iblFindLayer(at, iblLayers);
  vec3 even = textureLod(iblEvenLayers, direction, taps.even).rgb;
#ifdef IBL_MIRROR
  even = taps.isMirror ? textureLod(iblRadiance, direction, 0.0).rgb / iblStoredScale : even;
#endif
  // A layer that nobody made is read times 0; what is in it is finite.
  return mix(even, textureLod(iblOddLayers, direction, taps.odd).rgb, taps.oddShare);
}

// The same through a GGX lobe of perceptualRoughness.
vec3 iblPrefilteredRadiance(vec3 direction, float perceptualRoughness)
{
  return iblLayerRadiance(direction, iblLayerFromPerceptualRoughness(perceptualRoughness, iblLayers));
}
