#version 330 core
// A line as a quad of some pixels' width that faces the viewer; one instance per line.
layout(location = 0) in vec3 from; // mm from the origin
layout(location = 1) in vec3 to;
uniform mat4 view, projection;
uniform vec2 size;   // pixels, of what is drawn
uniform float width; // pixels
uniform float lift;  // mm towards the viewer
uniform vec4 kept;   // as in mesh.vert
uniform bool round_ends;
noperspective out vec2 at;    // pixels along the line from its start, and across from its middle
noperspective out float span; // pixels, length of the line

void main()
{
    vec4 seen_from = view * vec4(from, 1), seen_to = view * vec4(to, 1);
    seen_from.z += lift;
    seen_to.z += lift;
    vec4 a = projection * seen_from, b = projection * seen_to;
    float kept_a = dot(kept.xyz, from) + kept.w, kept_b = dot(kept.xyz, to) + kept.w;

    // What lies behind the viewer is cut off here: it has no place on the screen.
    float front_a = a.z + a.w, front_b = b.z + b.w;
    if (front_a < 0.0 && front_b < 0.0) {
        gl_Position = vec4(2, 2, 2, 1);
        gl_ClipDistance[0] = -1.0;
        at = vec2(0);
        span = 0.0;
        return;
    }
    vec4 whole_a = a;
    float whole_kept_a = kept_a;
    if (front_a < 0.0) {
        float share = front_a / (front_a - front_b) + 1e-4;
        a = mix(a, b, share);
        kept_a = mix(kept_a, kept_b, share);
    }
    if (front_b < 0.0) {
        float share = front_b / (front_b - front_a) + 1e-4;
        b = mix(b, whole_a, share);
        kept_b = mix(kept_b, whole_kept_a, share);
    }

    vec2 start = 0.5 * size * a.xy / a.w, end = 0.5 * size * b.xy / b.w;
    span = length(end - start);
    vec2 along = span > 1e-6 ? (end - start) / span : vec2(1, 0);
    vec2 across = vec2(-along.y, along.x);

    float margin = 0.5 * max(width, 1.0) + 1.0; // one pixel more for the soft border
    bool at_end = gl_VertexID >= 2;
    at.x = at_end ? span + (round_ends ? margin : 0.0) : (round_ends ? -margin : 0.0);
    at.y = gl_VertexID % 2 == 0 ? margin : -margin;
    vec4 near_by = at_end ? b : a;
    gl_ClipDistance[0] = at_end ? kept_b : kept_a;
    gl_Position = vec4((start + at.x * along + at.y * across) / (0.5 * size) * near_by.w, near_by.zw);
}
