// Hands on the number of the edge or triangle; the stages after it fetch what they need.
layout(location = 0) flat out uint number;

void main() {
    number = gl_VertexIndex;
}
