#version 330 core
uniform vec4 dot_colour, rim_colour;
uniform float diameter, rim; // pixels
noperspective in vec2 at;
out vec4 colour;

void main()
{
    float away = length(at), radius = 0.5 * diameter;
    float cover = clamp(radius + 0.5 - away, 0.0, 1.0);
    if (cover <= 0.0)
        discard;
    float inside = rim > 0.0 ? clamp(radius - rim + 0.5 - away, 0.0, 1.0) : 1.0;
    colour = mix(rim_colour, dot_colour, inside);
    colour.a *= cover;
}
