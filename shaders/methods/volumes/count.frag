// Counts by blending.
#include "methods/volumes/count.glsl"

void main() {
    count();
}
