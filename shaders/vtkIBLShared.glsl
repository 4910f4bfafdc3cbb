// Constants that GLSL and C++ both read: #define only.

// Compute shaders work on square tiles.
#define IBL_TILE 8

// Rough layers of one dispatch: as many images as any OpenGL 4.5 lets a compute shader write.
#define IBL_ROUGH_LAYERS 8

// Layers are half floats.
#define IBL_LARGEST_HALF 65504.0

// Rec. 709. (GLSL only.)
#define IBL_LUMINANCE vec3(0.2126, 0.7152, 0.0722)

// iblSplitSum: the geometry term.
#define IBL_SMITH_CORRELATED 0
#define IBL_SCHLICK_SMITH 1
