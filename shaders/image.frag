// Colors the warped picture: the texture, a heat map or a checker. Premultiplied alpha. COLORING is
// 0: picture, 1: heat, 2: checker, 3: one color, 4: tinted picture, 5: page or 6: shadow. It is a
// constant, because software drivers compute all branches of a condition at each pixel.
uniform sampler2D picture;
uniform sampler1D colors;
uniform vec4 flat_color;
uniform vec4 other_color;    // the second color of the page
uniform float cell_size;     // of the page's checkerboard, in plane units
uniform float softness;      // standard deviation of the shadow, in plane units
uniform vec2 rectangle_corner, rectangle_size;  // of the page, in plane units

in vec2 uv;
in vec2 rest_position;
in float shade;

out vec4 color;

// The integral of a Gaussian up to x, in standard deviations.
float smooth_step(float x) {
  return 1.0 / (1.0 + exp(-1.702 * x));
}

void main() {
#if COLORING == 0
  color = texture(picture, uv);
#elif COLORING == 1
  color = vec4(texture(colors, clamp(shade, 0.0, 1.0)).rgb, 1.0);
#elif COLORING == 2
  // A box-filtered checker: exact where cells are large, gray where they are smaller than a pixel.
  vec2 cell = rest_position / 16.0;
  vec2 width = max(fwidth(cell), vec2(1e-6));
  vec2 wave = 2.0 * (abs(fract((cell - 0.5 * width) * 0.5) - 0.5) - abs(fract((cell + 0.5 * width) * 0.5) - 0.5)) / width;
  float light = 0.5 - 0.5 * wave.x * wave.y;
  color = vec4(mix(vec3(0.275, 0.353, 0.471), vec3(0.922), light), 1.0);
#elif COLORING == 4
  vec4 here = texture(picture, uv);
  color = flat_color.a * vec4(mix(here.rgb, here.a * flat_color.rgb, 0.5), here.a);
#elif COLORING == 5
  vec2 cell = floor((rest_position - rectangle_corner) / cell_size);
  color = mod(cell.x + cell.y, 2.0) < 0.5 ? flat_color : other_color;
#elif COLORING == 6
  // A box blurred by a Gaussian, shifted down by half the softness.
  vec2 at = rest_position - rectangle_corner + vec2(0.0, 0.5 * softness);
  vec2 low = at / softness, high = (rectangle_size - at) / softness;
  float covered = smooth_step(low.x) * smooth_step(high.x) * smooth_step(low.y) * smooth_step(high.y);
  color = vec4(0.0, 0.0, 0.0, flat_color.a * covered);
#else
  color = flat_color;
#endif
}
