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

// Roughness as the BRDF table holds it, a position in [0, 1] on any ladder: the first fifth up to layer 1, evenly in roughness, and
// from there evenly in layers. No logarithm is left to the shader.
float iblLadderPosition(float perceptualRoughness)
{
  return perceptualRoughness < IBL_FIRST_ROUGHNESS
    ? 0.2 * perceptualRoughness / IBL_FIRST_ROUGHNESS
    : 0.2 + 0.8 * (1.0 - log2(min(perceptualRoughness, 1.0)) / IBL_LOG2_FIRST_ROUGHNESS);
}

float iblPerceptualRoughnessFromPosition(float position)
{
  return position < 0.2 ? 5.0 * position * IBL_FIRST_ROUGHNESS
                        : exp2(IBL_LOG2_FIRST_ROUGHNESS * (1.0 - 1.25 * (position - 0.2)));
}

float iblLayerFromPosition(float position, float layers)
{
  return position < 0.2 ? 5.0 * position : 1.0 + (layers - 1.0) * (1.25 * (position - 0.2));
}

// Layer of the lobe that covers, from the probe, what one at `layer` covers from a surface that is `ratio` times as far from there:
// GGX's width is its alpha, so roughness goes with the ratio's root (Lagarde & de Rousiers 2014, section 4.9.5, but for their way back
// at roughness 1, which is further from the integral), and layers with its logarithm. A mirror stays one.
float iblLayerFromProbe(float layer, float layers, float ratio)
{
  float perOctave = 0.5 * (layers - 1.0) / (-IBL_LOG2_FIRST_ROUGHNESS);
  return clamp(layer + min(layer, 1.0) * perOctave * log2(max(ratio, 1e-6)), 0.0, layers);
}
