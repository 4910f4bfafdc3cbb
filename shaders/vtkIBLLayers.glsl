// Reads the specular ladder: layers alternate between two cube maps, one a mip level.
uniform samplerCube iblEvenLayers;
uniform samplerCube iblOddLayers;

#include "vtkIBLLadderFunctions.glsl"

// Stored light from direction [environment space] through a GGX lobe of perceptualRoughness.
vec3 iblPrefilteredRadiance(vec3 direction, float perceptualRoughness)
{
  float layer = clamp(iblLayerFromPerceptualRoughness(perceptualRoughness), 0.0, float(IBL_LAYER_COUNT - 1));
  float below = min(floor(layer), float(IBL_LAYER_COUNT - 2));
  float evenLevel = floor(0.5 * (below + 1.0));
  float oddLevel = floor(0.5 * below);
  vec3 even = textureLod(iblEvenLayers, direction, evenLevel).rgb;
  vec3 odd = textureLod(iblOddLayers, direction, oddLevel).rgb;
  bool belowIsEven = 2.0 * evenLevel == below;
  float share = layer - below;
  return mix(even, odd, belowIsEven ? share : 1.0 - share);
}
