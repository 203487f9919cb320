/* SPDX-License-Identifier: GPL-3.0-or-later */
#define GL_GLEXT_PROTOTYPES 1
#include "bench/peers/shared/offscreen.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Sets the variables that Mesa reads when it starts. LP_NUM_THREADS is 0 if
 * only the caller draws. */
static bool choose_llvmpipe(long threads) {
  char number[24];
  snprintf(number, sizeof number, "%ld", threads > 1 ? threads : 0);
  return !setenv("LP_NUM_THREADS", number, 1) &&
         !setenv("GALLIUM_DRIVER", "llvmpipe", 1) &&
         !setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1) &&
         !setenv("EGL_LOG_LEVEL", "fatal", 1);
}

static enum hsr_status make_context(struct offscreen *offscreen,
                                    bool compatible, struct hsr_error *err) {
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                           3,
                           EGL_CONTEXT_MINOR_VERSION,
                           3,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           compatible
                               ? EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT
                               : EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                           EGL_NONE};
  offscreen->display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                             EGL_DEFAULT_DISPLAY, NULL);
  if (offscreen->display && eglInitialize(offscreen->display, NULL, NULL) &&
      eglBindAPI(EGL_OPENGL_API))
    offscreen->context = eglCreateContext(offscreen->display, EGL_NO_CONFIG_KHR,
                                          EGL_NO_CONTEXT, wanted);
  return offscreen->context &&
                 eglMakeCurrent(offscreen->display, EGL_NO_SURFACE,
                                EGL_NO_SURFACE, offscreen->context)
             ? HSR_OK
             : hsr_fail(err, HSR_E_INTERNAL,
                        "EGL makes no surfaceless context of OpenGL 3.3");
}

enum hsr_status offscreen_open(struct offscreen *offscreen, bool compatible,
                               long threads, struct hsr_error *err) {
  *offscreen = (struct offscreen){.context = NULL};
  if (!choose_llvmpipe(threads))
    return hsr_fail_nomem(err);
  enum hsr_status status = make_context(offscreen, compatible, err);
  if (status)
    return status;
  const char *renderer = (const char *)glGetString(GL_RENDERER);
  return renderer && !strncmp(renderer, "llvmpipe", 8)
             ? HSR_OK
             : hsr_fail(err, HSR_E_INTERNAL, "OpenGL is drawn by %.60s",
                        renderer ? renderer : "nothing");
}

enum hsr_status offscreen_raster(int m, int n, struct hsr_error *err) {
  GLuint frame, buffer[2];
  glGenFramebuffers(1, &frame);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  glGenRenderbuffers(2, buffer);
  static const GLenum format[2] = {GL_RGBA8, GL_DEPTH_COMPONENT24};
  static const GLenum place[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
  for (int k = 0; k < 2; k++) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer[k]);
    glRenderbufferStorage(GL_RENDERBUFFER, format[k], m, n);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place[k], GL_RENDERBUFFER,
                              buffer[k]);
  }
  glViewport(0, 0, m, n);
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE
             ? HSR_OK
             : hsr_fail(err, HSR_E_INTERNAL, "llvmpipe: no raster of %d x %d",
                        m, n);
}

void offscreen_close(struct offscreen *offscreen) {
  if (!offscreen->display)
    return;
  eglMakeCurrent(offscreen->display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                 EGL_NO_CONTEXT);
  if (offscreen->context)
    eglDestroyContext(offscreen->display, offscreen->context);
  eglTerminate(offscreen->display);
  eglReleaseThread();
}

void offscreen_version(char *text, int size) {
  struct offscreen offscreen;
  struct hsr_error err;
  text[0] = '\0';
  if (!offscreen_open(&offscreen, false, 1, &err)) {
    const char *all = (const char *)glGetString(GL_VERSION);
    const char *mesa = all ? strstr(all, "Mesa") : NULL;
    if (mesa)
      snprintf(text, (size_t)size, "%s", mesa);
  }
  offscreen_close(&offscreen);
}
