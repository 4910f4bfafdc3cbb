// The environment behind the scene, sharp or as a rough mirror shows it.
// Reads: the specular ladder, see vtkIBLLayers.glsl.
in vec2 ndc;
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 positionVC; // these two for vtkSSAOPass, where it has buffers of them: a sky far behind
layout(location = 2) out vec4 normalVC;   // whatever there is, which occludes nothing; 6e4: they are half floats
uniform float blur;             // perceptualRoughness; 0: sharp
uniform float sharpLevel;       // mip level to read it at when sharp
uniform vec2 viewScale;         // view-space x and y at depth 1 are (ndc + viewShift) * viewScale
uniform vec2 viewShift;
uniform mat3 environmentFromView;
uniform vec3 radianceScale;
uniform float encodingExponent; // 1: linear; 1/2.2: display, as VTK encodes its PBR surfaces
// Lamps that layers are without, environment space, as a mirror of that roughness shows them: Scale t / (1 - k t)^2.
uniform int lampCount;
uniform vec3 lampDirections[IBL_MAXIMUM_LAMPS];
uniform vec3 lampPowers[IBL_MAXIMUM_LAMPS];
uniform vec3 lampKernels[IBL_MAXIMUM_LAMPS]; // k, 1 - k, Scale

#define IBL_MIRROR
#include "vtkIBLLayers.glsl"

void main()
{
  vec3 direction = environmentFromView * vec3((ndc + viewShift) * viewScale, -1.0);
  vec3 radiance = blur == 0.0 ? textureLod(iblRadiance, direction, sharpLevel).rgb
                              : iblPrefilteredRadiance(direction, blur) * iblStoredScale;
  for (int i = 0; i < lampCount; ++i)
  {
    vec3 apart = normalize(direction) - lampDirections[i];
    float oneMinusT = 0.5 * dot(apart, apart);
    float w = lampKernels[i].y + lampKernels[i].x * oneMinusT;
    radiance += lampPowers[i] * (lampKernels[i].z * max(1.0 - oneMinusT, 0.0) / (w * w));
  }
  positionVC = vec4(0.0, 0.0, -6e4, 1.0);
  normalVC = vec4(0.0, 0.0, 1.0, 1.0);
  color = vec4(pow(radiance * radianceScale, vec3(encodingExponent)), 1.0);
}
