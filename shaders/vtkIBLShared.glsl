// Constants that GLSL and C++ both read: #define only.

// Compute shaders work on square tiles.
#define IBL_TILE 8

// Rough layers of one dispatch: as many images as any OpenGL 4.5 lets a compute shader write.
#define IBL_ROUGH_LAYERS 8

// Layers are half floats.
#define IBL_LARGEST_HALF 65504.0

// What is brighter is no light but a fault.
#define IBL_LARGEST_RADIANCE 1e10

// Rec. 709. (GLSL only.)
#define IBL_LUMINANCE vec3(0.2126, 0.7152, 0.0722)

// The BRDF table's second set of lobes is a dielectric's of this f0 (index of refraction 1.5).
#define IBL_DIELECTRIC_F0 0.04

// The BRDF table's blocks are squares of so many texels.
#define IBL_TABLE_SIZE 64

// Isotropic lobes that stand for an anisotropic one.
#define IBL_ANISOTROPIC_LOBES 7

// Bright texels that shading takes as lights.
#define IBL_MAXIMUM_LAMPS 8

// Probes that one actor is lit by, vec4s that tell the shader of each, and shapes of their proxies.
#define IBL_MAXIMUM_PROBES 4
#define IBL_PROBE_NUMBERS 11
#define IBL_PROXY_NONE 0.0
#define IBL_PROXY_BOX 1.0
#define IBL_PROXY_BALL 2.0

// iblSplitSum: the geometry term.
#define IBL_SMITH_CORRELATED 0
#define IBL_SCHLICK_SMITH 1
