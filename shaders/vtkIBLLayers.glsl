// Reads the specular ladder: odd layers are the mip levels of one cube map, even ones those of another.
uniform samplerCube iblRadiance;
uniform samplerCube iblOddLayers;
uniform samplerCube iblEvenLayers;
uniform float iblLayers;      // number of the last layer
uniform float iblStoredScale; // what layers are divided by, and the radiance cube is not

#include "vtkIBLLadderFunctions.glsl"

// Stored light from direction [environment space] at a layer, or between two.
vec3 iblLayerRadiance(vec3 direction, float at)
{
  float layer = clamp(at, 0.0, iblLayers);
  float below = min(floor(layer), iblLayers - 1.0);
  float share = layer - below;
  float level = floor(0.5 * below);
  bool belowIsEven = 2.0 * level == below;
  vec3 even = below == 0.0 ? textureLod(iblRadiance, direction, 0.0).rgb / iblStoredScale
                           : textureLod(iblEvenLayers, direction, belowIsEven ? level - 1.0 : level).rgb;
  vec3 odd = share == 0.0 && belowIsEven ? even : textureLod(iblOddLayers, direction, level).rgb;
  return mix(even, odd, belowIsEven ? share : 1.0 - share);
}

// The same through a GGX lobe of perceptualRoughness.
vec3 iblPrefilteredRadiance(vec3 direction, float perceptualRoughness)
{
  return iblLayerRadiance(direction, iblLayerFromPerceptualRoughness(perceptualRoughness, iblLayers));
}
