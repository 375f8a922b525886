// Passes the number of the edge or triangle through; later stages fetch what they need.
layout(location = 0) flat out uint number;

void main() {
    number = gl_VertexIndex;
}
