// A vertex by its number, with w = 0 where there is none.
#include "shared/frame.glsl"

layout(location = 0) out vec4 corner;

void main() {
    corner = positions[gl_VertexIndex];
}
