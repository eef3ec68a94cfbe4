#pragma once

#include <EGL/egl.h>
#include <GL/glcorearb.h>

#include <memory>
#include <string>

namespace hemicube::bench {

/// The functions of OpenGL that the llvmpipe peer calls: the type, and the name without its gl.
#define HC_GL_FUNCTIONS(F)                                                                         \
  F(PFNGLATTACHSHADERPROC, AttachShader)                                                           \
  F(PFNGLBINDBUFFERPROC, BindBuffer)                                                               \
  F(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                     \
  F(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                                                   \
  F(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                     \
  F(PFNGLBUFFERDATAPROC, BufferData)                                                               \
  F(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                                       \
  F(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                                                         \
  F(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                                                       \
  F(PFNGLCLIPCONTROLPROC, ClipControl)                                                             \
  F(PFNGLCOMPILESHADERPROC, CompileShader)                                                         \
  F(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                         \
  F(PFNGLCREATESHADERPROC, CreateShader)                                                           \
  F(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                         \
  F(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                               \
  F(PFNGLDEPTHFUNCPROC, DepthFunc)                                                                 \
  F(PFNGLENABLEPROC, Enable)                                                                       \
  F(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                                     \
  F(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)                                     \
  F(PFNGLFRONTFACEPROC, FrontFace)                                                                 \
  F(PFNGLGENBUFFERSPROC, GenBuffers)                                                               \
  F(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                                     \
  F(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                                                   \
  F(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                                     \
  F(PFNGLGETERRORPROC, GetError)                                                                   \
  F(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                           \
  F(PFNGLGETSTRINGPROC, GetString)                                                                 \
  F(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                               \
  F(PFNGLLINKPROGRAMPROC, LinkProgram)                                                             \
  F(PFNGLMULTIDRAWELEMENTSPROC, MultiDrawElements)                                                 \
  F(PFNGLPROVOKINGVERTEXPROC, ProvokingVertex)                                                     \
  F(PFNGLREADPIXELSPROC, ReadPixels)                                                               \
  F(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)                                             \
  F(PFNGLSHADERSOURCEPROC, ShaderSource)                                                           \
  F(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                                                   \
  F(PFNGLUSEPROGRAMPROC, UseProgram)                                                               \
  F(PFNGLVERTEXATTRIBIPOINTERPROC, VertexAttribIPointer)                                           \
  F(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                                             \
  F(PFNGLVIEWPORTPROC, Viewport)

struct GlFunctions {
#define HC_DECLARE(type, name) type name = nullptr;
  HC_GL_FUNCTIONS(HC_DECLARE)
#undef HC_DECLARE
};

/// An OpenGL 4.5 core context of Mesa's llvmpipe without a window, drawing on the thread that calls
/// it and on no other. Current on the thread that opened it until it is destroyed.
class EglContext {
public:
  /// @param why  what is missing, where null is returned
  static std::unique_ptr<EglContext> open(std::string* why);

  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext();

  /// The driver and its version, as it calls itself.
  std::string description() const;

  GlFunctions gl;

private:
  EglContext() = default;
  bool create(std::string* why);

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace hemicube::bench
