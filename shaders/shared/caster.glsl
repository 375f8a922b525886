// The objects whose volumes are drawn. Twin of `constants` in src/methods/volumes.rs.
layout(push_constant) uniform Caster {
    // Which of frame.end_planes the volumes end on.
    uint end_plane;
    // Not 0 if only triangles that face the light cast: those of closed objects.
    uint light_facing_only;
    // Where the elements of the draw begin and end: of the edges, triangles or what else a task or mesh shader takes.
    uint first_element;
    uint end_element;
} caster;
