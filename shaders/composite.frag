// Combines a layer with what is below it, pixel by pixel, as exports do (raster/compose.cpp).
// Premultiplied alpha.
uniform sampler2D under_layers;
uniform sampler2D over_layer;
uniform int blending;   // -1: copy `under_layers`; -2: see below; else the number of the mode
uniform float opacity;
uniform bool clipped;   // the layer changes the colors of its base, but not its shape

out vec4 color;

vec3 straight(vec4 premultiplied) {
  return premultiplied.a > 0.0 ? premultiplied.rgb / premultiplied.a : vec3(0.0);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 under = texelFetch(under_layers, at, 0);
  if (blending == -1) {
    color = under;
    return;
  }
  vec4 over = texelFetch(over_layer, at, 0);
  if (blending == -2) {  // `under_layers`, cut to the gaps of `over_layer`
    const float kCovered = 0.998;  // half floats round opaque pixels to a little less
    float filled = over.a < kCovered ? max(0.0, under.a - over.a) / (1.0 - over.a) : 0.0;
    color = vec4(straight(under) * filled, filled);
    return;
  }
  vec3 cs = straight(over), cb = straight(under), mixed = cs;
  float a = over.a * opacity, b = under.a;
  if (blending == 1) mixed = cs * cb;
  if (blending == 2) mixed = cs + cb - cs * cb;
  if (blending == 3) {
    vec3 dark = 2.0 * cs * cb, light = 1.0 - 2.0 * (1.0 - cs) * (1.0 - cb);
    mixed = mix(light, dark, vec3(lessThan(cb, vec3(0.5))));
  }
  if (blending == 4) mixed = min(cs + cb, 1.0);
  if (clipped) {
    color = vec4(b * mix(cb, mixed, a), b);
    return;
  }
  color = vec4(a * (1.0 - b) * cs + b * (1.0 - a) * cb + a * b * mixed, a + b - a * b);
}
