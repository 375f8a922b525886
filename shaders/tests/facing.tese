// Never runs: every patch is discarded.
layout(quads) in;

void main() {
    gl_Position = vec4(0.0);
}
