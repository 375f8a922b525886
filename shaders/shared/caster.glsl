// The object whose volume is drawn. Twin of `constants` in src/methods/volumes.rs.
layout(push_constant) uniform Caster {
    // Which of frame.end_planes the volume ends on.
    uint end_plane;
    // Not 0 if only triangles that face the light cast: those of a closed object.
    uint light_facing_only;
} caster;
