// One more frame into the mean of those before it, and the mean to the framebuffer, depth and all.
// Reads: the frame, display-encoded or not. Reads and writes: the mean, not encoded.
layout(rgba32f, binding = 0) uniform image2D mean;
uniform sampler2D frame;
uniform sampler2D frameDepth;
uniform sampler2DMS frameSamples; // in place of both above when there is multisampling
uniform sampler2DMS frameDepthSamples;
uniform int sampleCount;          // of that; 0: none
uniform float weight;             // of this frame: 1 for the first of n, 1/n for the last, 0 to show the mean once more
uniform float decodingExponent;   // 2.2, or 1 when frames are linear
out vec4 color;

vec4 decode(vec4 encoded)
{
  return vec4(decodingExponent == 1.0 ? encoded.rgb : pow(max(encoded.rgb, 0.0), vec3(decodingExponent)), encoded.a);
}

vec4 encode(vec4 decoded)
{
  return vec4(decodingExponent == 1.0 ? decoded.rgb : pow(decoded.rgb, vec3(1.0 / decodingExponent)), decoded.a);
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 drawn = sampleCount == 0 ? texelFetch(frame, pixel, 0) : texelFetch(frameSamples, pixel, 0);
  gl_FragDepth = sampleCount == 0 ? texelFetch(frameDepth, pixel, 0).r : texelFetch(frameDepthSamples, pixel, 0).r;
  // As VTK resolves its own multisampled framebuffer: radiance, not display values.
  vec4 now = decode(drawn);
  for (int i = 1; i < sampleCount; ++i)
  {
    now += decode(texelFetch(frameSamples, pixel, i));
  }
  now /= float(max(sampleCount, 1));
  vec4 before = weight == 1.0 ? now : imageLoad(mean, pixel);
  vec4 after = before + weight * (now - before); // stays exactly what it was where every frame is the same...
  imageStore(mean, pixel, after);
  // ... and there, what was drawn is shown, not what encoding makes of it.
  color = mix(encode(after), drawn, equal(after, decode(drawn)));
}
