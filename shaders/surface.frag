// Colors a surface with the picture, lit from the camera. The picture is premultiplied by alpha.
uniform sampler2D picture;
uniform bool textured;
uniform vec3 clay;     // the color where there is no picture

in vec2 uv;
in vec3 seen;
in vec3 seen_normal;

out vec4 color;

// Just outside the picture's edge, smaller mipmap levels still have its colors. Using them avoids a
// seam at the boundary.
vec4 bled(vec4 here) {
  for (float level = 1.0; level < 6.0 && here.a < 0.99; level += 1.0) {
    vec4 wide = textureLod(picture, uv, level);
    if (wide.a > 0.25) here += (1.0 - here.a) * vec4(wide.rgb / wide.a, 1.0);
  }
  return here;
}

void main() {
  vec4 here = textured ? bled(texture(picture, uv)) : vec4(0.0);
  vec3 n = seen_normal / max(length(seen_normal), 1e-30);
  bool behind = dot(n, seen) > 0.0;
  if (behind) n = -n;
  vec3 light = normalize(vec3(-0.35, 0.55, 1.0));
  float lit = (0.5 + 0.55 * max(dot(n, light), 0.0)) * (behind ? 0.55 : 1.0);
  color = vec4(min(lit, 1.0) * (here.rgb + (1.0 - here.a) * clay), 1.0);
}
