#version 330 core
layout(location = 0) in vec3 position; // mm from the origin of the mesh
layout(location = 1) in vec3 normal;   // unit; 0: that of the face
layout(location = 2) in float value;   // of the field, if it has one value per vertex
uniform mat4 view, projection;
uniform vec4 kept;  // what is not cut away: kept.xyz . position + kept.w >= 0, mm
uniform float push; // mm away from the viewer
out vec3 place;     // mm, in the axes of the camera
out vec3 turned_normal;
out float vertex_value;

void main()
{
    vec4 seen = view * vec4(position, 1);
    place = seen.xyz;
    seen.z -= push;
    turned_normal = mat3(view) * normal;
    vertex_value = value;
    gl_Position = projection * seen;
    gl_ClipDistance[0] = dot(kept.xyz, position) + kept.w;
}
