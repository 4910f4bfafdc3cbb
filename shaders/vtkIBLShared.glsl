// Constants that GLSL and C++ both read: #define only.

// The specular ladder: layer i lives in chain (i mod 2), mip level i / 2; see vtkIBLLadderFunctions.glsl.
#define IBL_LAYER_COUNT 10
#define IBL_CHAIN_LEVELS 5

// Compute shaders work on square tiles.
#define IBL_TILE 8

// iblSplitSum: the geometry term.
#define IBL_SMITH_CORRELATED 0
#define IBL_SCHLICK_SMITH 1
