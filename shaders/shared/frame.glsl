// What native stages read. Twin of shared/frame.wgsl and of src/frame/uniform.rs; see there.
layout(set = 0, binding = 0, std140) uniform Frame {
    mat4 view_projection;
    mat4 clip_to_eye_ray;
    vec4 light;
    vec4 eye;
    vec4 picture;
    vec4 end_planes[7];
} frame;

layout(set = 0, binding = 1, std430) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 2, std430) readonly buffer Indices { uint indices[]; };
