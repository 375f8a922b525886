// Passes a vertex's position through from the vertex buffer.
layout(location = 0) in vec3 vertex;
layout(location = 0) out vec3 position;

void main() {
    position = vertex;
}
