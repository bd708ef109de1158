#version 330 core
// A line as a quad of some pixels' width that faces the viewer; one instance per line.
layout(location = 0) in vec3 from; // mm from the origin
layout(location = 1) in vec3 to;
uniform mat4 view, projection;
uniform vec2 size;   // pixels, of what is drawn
uniform float width; // pixels
uniform float lift;  // mm towards the viewer
uniform bool round_ends;
noperspective out vec2 at;    // pixels along the line from its start, and across from its middle
noperspective out float span; // pixels, length of the line

void main()
{
    vec4 seen_from = view * vec4(from, 1), seen_to = view * vec4(to, 1);
    seen_from.z += lift;
    seen_to.z += lift;
    vec4 a = projection * seen_from, b = projection * seen_to;

    // What lies behind the viewer is cut off here: it has no place on the screen.
    float front_a = a.z + a.w, front_b = b.z + b.w;
    if (front_a < 0.0 && front_b < 0.0) {
        gl_Position = vec4(2, 2, 2, 1);
        at = vec2(0);
        span = 0.0;
        return;
    }
    vec4 whole_a = a;
    if (front_a < 0.0)
        a = mix(a, b, front_a / (front_a - front_b) + 1e-4);
    if (front_b < 0.0)
        b = mix(b, whole_a, front_b / (front_b - front_a) + 1e-4);

    vec2 start = 0.5 * size * a.xy / a.w, end = 0.5 * size * b.xy / b.w;
    span = length(end - start);
    vec2 along = span > 1e-6 ? (end - start) / span : vec2(1, 0);
    vec2 across = vec2(-along.y, along.x);

    float margin = 0.5 * max(width, 1.0) + 1.0; // one pixel more for the soft border
    bool at_end = gl_VertexID >= 2;
    at.x = at_end ? span + (round_ends ? margin : 0.0) : (round_ends ? -margin : 0.0);
    at.y = gl_VertexID % 2 == 0 ? margin : -margin;
    vec4 near_by = at_end ? b : a;
    gl_Position = vec4((start + at.x * along + at.y * across) / (0.5 * size) * near_by.w, near_by.zw);
}
