// Corners that a compute pass has written, in clip space.
layout(std430, set = 0, binding = 0) readonly buffer Corners {
    vec4 corners[];
};

void main() {
    gl_Position = corners[gl_VertexIndex];
}
