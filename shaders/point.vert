#version 330 core
// A round dot of some pixels across; one instance per point.
layout(location = 0) in vec3 position; // mm from the origin
uniform mat4 view, projection;
uniform vec2 size;      // pixels, of what is drawn
uniform float diameter; // pixels, rim included
uniform float lift;     // mm towards the viewer
uniform vec4 kept;      // as in mesh.vert
noperspective out vec2 at; // pixels from the middle

void main()
{
    vec4 seen = view * vec4(position, 1);
    seen.z += lift;
    vec4 middle = projection * seen;
    at = (0.5 * diameter + 1.0) * vec2(gl_VertexID % 2 == 0 ? -1 : 1, gl_VertexID < 2 ? -1 : 1);
    gl_Position = middle + vec4(at / (0.5 * size) * middle.w, 0, 0);
    gl_ClipDistance[0] = dot(kept.xyz, position) + kept.w;
}
