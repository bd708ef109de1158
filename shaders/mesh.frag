#version 330 core
// Colour of a field or a plain one, bands and isolines, light, and what is marked.
in vec3 place; // mm, in the axes of the camera: x right, y up, z towards the viewer
in vec3 turned_normal;
in float vertex_value;
out vec4 colour;

uniform vec4 front, back; // plain colours of the outer and the inner side
uniform bool lit, zebra;
uniform float pixel; // pixels of the screen per pixel of the design
uniform vec2 corner; // pixels, of the tile that is drawn in the picture

uniform bool has_field, per_face;
uniform samplerBuffer face_value;
uniform sampler1D map;
uniform float least, greatest;
uniform bool about_zero; // the middle of the map is at zero: place_in_map() in colours.h
uniform int bands, ticks; // bands 0: smooth
uniform bool isolines;
uniform vec4 no_value;

uniform bool coarse;            // the triangles stand for some of the mesh's
uniform usamplerBuffer face_of; // which

uniform bool has_marks;
uniform usamplerBuffer face_mark;
uniform vec4 region_colour[64];
uniform vec4 selected_colour;
const uint region = 0x3fu, hovered = 0x40u, selected = 0x80u;

int face() { return coarse ? int(texelFetch(face_of, gl_PrimitiveID).r) : gl_PrimitiveID; }

float slope(float x) { return max(length(vec2(dFdx(x), dFdy(x))), 1e-12); } // per pixel

/// 0..1 across the picture in slanted stripes: so many pixels from one to the next, of which they cover a share.
float stripes(float width, float share)
{
    vec2 at = (gl_FragCoord.xy + corner) / pixel;
    float wave = (0.5 - abs(fract((at.x + at.y) / width) - 0.5)) * width; // pixels from the middle of a stripe
    return clamp(0.5 * share * width - wave + 0.5, 0.0, 1.0);
}

vec3 map_colour(float share)
{
    float t = share;
    if (about_zero) {
        float value = least + clamp(share, 0.0, 1.0) * (greatest - least);
        t = value < 0.0 ? (least < 0.0 ? 0.5 - 0.5 * value / least : 0.0)
                        : (greatest > 0.0 ? 0.5 + 0.5 * value / greatest : 0.5);
    }
    float texels = float(textureSize(map, 0));
    return texture(map, (clamp(t, 0.0, 1.0) * (texels - 1.0) + 0.5) / texels).rgb;
}

/// The outer bands have the colours of the scale's ends.
vec3 band_colour(float band)
{
    float last = float(bands - 1);
    return map_colour(last > 0.0 ? clamp(band, 0.0, last) / last : 0.5);
}

bool is_number(float x) { return (floatBitsToUint(x) & 0x7fffffffu) <= 0x7f800000u; } // isnan() is often optimised away

vec3 field_colour()
{
    float value = per_face ? texelFetch(face_value, face()).r : vertex_value;
    float t = greatest > least ? (value - least) / (greatest - least) : 0.5;
    float along = t * float(ticks), steepness = slope(along), band_slope = slope(t * float(max(bands, 1)));
    if (!is_number(value))
        return no_value.rgb * mix(0.86, 1.06, stripes(7.0, 0.5));

    vec3 result;
    if (bands > 0 && !per_face) { // the border of two bands blends over one pixel
        float x = t * float(bands), border = clamp(round(x), 1.0, max(1.0, float(bands) - 1.0));
        result = mix(band_colour(border - 1.0), band_colour(border), clamp((x - border) / band_slope + 0.5, 0.0, 1.0));
        if (abs(x - border) > 0.5)
            result = band_colour(floor(x));
    } else {
        result = bands > 0 ? band_colour(floor(t * float(bands))) : map_colour(t);
    }
    if (isolines && !per_face) {
        float tick = clamp(round(along), 0.0, float(ticks));
        float ink = clamp(0.5 * 1.3 * pixel + 0.5 - abs(along - tick) / steepness, 0.0, 1.0);
        ink *= clamp(2.0 - 4.0 * steepness, 0.0, 1.0); // lines closer than two to four pixels would be a black patch
        result = mix(result, vec3(0.05, 0.06, 0.08), 0.8 * ink);
    }
    return result;
}

/// A light above the viewer's left shoulder, a soft one from the right below, and some from everywhere.
float light(vec3 normal)
{
    float key = max(dot(normal, normalize(vec3(-0.35, 0.55, 0.80))), 0.0);
    float soft = max(dot(normal, normalize(vec3(0.70, -0.35, 0.45))), 0.0);
    return 0.44 + 0.58 * key + 0.18 * soft;
}

/// Rows of lamps above and beside the sheet, mirrored in it, and as dark between them as they are wide: 0.22 or 1. The stripes are
/// where the mirrored ray has one slope, so they are as smooth as the normals are: one derivative less than the surface.
float lamps(vec3 normal)
{
    vec3 ray = reflect(vec3(0, 0, -1), normal); // straight ahead: the picture of a far camera
    float along = 9.0 * atan(ray.x + ray.y, 1.0 + ray.z); // slanted: of walls along either axis
    float wave = abs(fract(along) - 0.5) - 0.25, blur = max(0.7 * length(vec2(dFdx(along), dFdy(along))), 1e-6);
    float stripe = blur > 0.45 ? 0.5 : clamp(0.5 + wave / (2.0 * blur), 0.0, 1.0);
    return mix(0.22, 1.0, stripe);
}

void main()
{
    vec3 flat_normal = normalize(cross(dFdx(place), dFdy(place)));
    vec3 normal = gl_FrontFacing ? turned_normal : -turned_normal;
    normal = dot(normal, normal) > 0.01 ? normalize(normal) : flat_normal;

    colour = gl_FrontFacing ? front : back;
    if (has_field) {
        colour.rgb = field_colour();
        if (!gl_FrontFacing && lit) // the inner side is darker and paler
            colour.rgb = mix(colour.rgb, vec3(dot(colour.rgb, vec3(0.3, 0.6, 0.1))), 0.25) * 0.72;
    }

    if (zebra)
        colour.rgb *= lamps(normal);

    uint mark = has_marks ? texelFetch(face_mark, face()).r : 0u;
    if ((mark & region) != 0u) {
        vec4 tint = region_colour[(mark & region) - 1u];
        colour.rgb = mix(colour.rgb, tint.rgb, tint.a * (has_field ? 0.0 : 0.4)); // a field keeps its colours
    }
    if ((mark & selected) != 0u) // between the stripes the field is read as everywhere else
        colour.rgb = mix(colour.rgb, selected_colour.rgb, has_field ? 0.9 * stripes(16.0, 0.25) : mix(0.45, 0.85, stripes(9.0, 0.5)));

    if (lit) {
        float shade = light(normal);
        colour.rgb *= has_field ? mix(1.0, shade, 0.6) : shade;
        if (!has_field) { // a dull gleam, as of sheet metal
            vec3 half_way = normalize(normalize(vec3(-0.35, 0.55, 0.80)) + vec3(0, 0, 1));
            colour.rgb += 0.10 * pow(max(dot(normal, half_way), 0.0), 24.0);
        }
    }
    if ((mark & hovered) != 0u) { // away from its own brightness: seen on any colour
        float brightness = dot(colour.rgb, vec3(0.30, 0.59, 0.11));
        colour.rgb = mix(colour.rgb, brightness > 0.5 ? vec3(0.05, 0.05, 0.1) : vec3(1), 0.55);
    }
}
