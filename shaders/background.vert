#version 330 core
// One triangle that covers the picture, or the tile of it that is drawn.
uniform vec2 shown; // heights of the lower and the upper border of the tile in the picture, 0..1
out float height;

void main()
{
    vec2 corner = vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1);
    height = mix(shown.x, shown.y, 0.5 * corner.y + 0.5);
    gl_Position = vec4(corner, 0, 1);
}
