#version 330 core
uniform vec4 line_colour;
uniform float width; // pixels
noperspective in vec2 at;
noperspective in float span;
out vec4 colour;

void main()
{
    float away = length(vec2(at.x - clamp(at.x, 0.0, span), at.y)); // pixels
    float cover = clamp(0.5 * max(width, 1.0) + 0.5 - away, 0.0, 1.0) * min(width, 1.0);
    if (cover <= 0.0)
        discard;
    colour = vec4(line_colour.rgb, line_colour.a * cover);
}
