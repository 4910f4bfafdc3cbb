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

// Stored light from direction [environment space] at a layer, or between two.
vec3 iblLayerRadiance(vec3 direction, float at)
{
#ifdef IBL_MIRROR
  const float sharpest = 0.0;
#else
  const float sharpest = 1.0;
#endif
  float layer = clamp(at, sharpest, iblLayers);
  float below = min(floor(layer), iblLayers - 1.0);
  float share = layer - below;
  float level = floor(0.5 * below);
  bool belowIsEven = 2.0 * level == below;
  vec3 even = textureLod(iblEvenLayers, direction, max(belowIsEven ? level - 1.0 : level, 0.0)).rgb;
#ifdef IBL_MIRROR
  even = below == 0.0 ? textureLod(iblRadiance, direction, 0.0).rgb / iblStoredScale : even;
#endif
  vec3 odd = share == 0.0 && belowIsEven ? even : textureLod(iblOddLayers, direction, level).rgb;
  return mix(even, odd, belowIsEven ? share : 1.0 - share);
}

// The same through a GGX lobe of perceptualRoughness.
vec3 iblPrefilteredRadiance(vec3 direction, float perceptualRoughness)
{
  return iblLayerRadiance(direction, iblLayerFromPerceptualRoughness(perceptualRoughness, iblLayers));
}
