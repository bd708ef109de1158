#version 330 core
// From one colour at the lower border to another at the upper one.
uniform vec4 lower, upper;
in float height;
out vec4 colour;

void main()
{
    // Half a step of 8 bits of noise hides the bands of a slow gradient.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    colour = mix(lower, upper, smoothstep(0.0, 1.0, height)) + (lower == upper ? 0.0 : noise / 255.0);
}
