// The specular ladder: which perceptualRoughness each prefiltered layer is made for, and which layers a roughness lies between.
// Layer 0 is the mirror: the radiance cube itself. Layer 1 has IBL_FIRST_ROUGHNESS, from there each is rougher by one ratio up
// to the last, `layers`, which has 1: a GGX lobe's width goes with alpha, so even steps of log r make the error of
// interpolation even.
#define IBL_FIRST_ROUGHNESS 0.1
#define IBL_LOG2_FIRST_ROUGHNESS (-3.32192809488736235)

float iblLayerFromPerceptualRoughness(float perceptualRoughness, float layers)
{
  return perceptualRoughness < IBL_FIRST_ROUGHNESS
    ? perceptualRoughness / IBL_FIRST_ROUGHNESS
    : 1.0 + (layers - 1.0) * (1.0 - log2(min(perceptualRoughness, 1.0)) / IBL_LOG2_FIRST_ROUGHNESS);
}

float iblPerceptualRoughnessFromLayer(float layer, float layers)
{
  return layer < 1.0 ? layer * IBL_FIRST_ROUGHNESS : exp2(IBL_LOG2_FIRST_ROUGHNESS * (1.0 - (layer - 1.0) / (layers - 1.0)));
}
