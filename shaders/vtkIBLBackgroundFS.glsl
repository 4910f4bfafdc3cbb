// The environment behind the scene, sharp or as a rough mirror shows it.
// Reads: the specular ladder, see vtkIBLLayers.glsl.
in vec2 ndc;
out vec4 color;
uniform float blur;             // perceptualRoughness; 0: sharp
uniform vec2 viewScale;         // view-space x and y at depth 1 are (ndc + viewShift) * viewScale
uniform vec2 viewShift;
uniform mat3 environmentFromView;
uniform vec3 radianceScale;
uniform float encodingExponent; // 1: linear; 1/2.2: display, as VTK encodes its PBR surfaces

#include "vtkIBLLayers.glsl"

void main()
{
  vec3 direction = environmentFromView * vec3((ndc + viewShift) * viewScale, -1.0);
  vec3 radiance = iblPrefilteredRadiance(direction, blur) * iblStoredScale;
  color = vec4(pow(radiance * radianceScale, vec3(encodingExponent)), 1.0);
}
