// SPDX-License-Identifier: BSD-3-Clause
// //VTK::Light::Impl of the fragment shader. Before it stand VTK's ambientColor, diffuseColor,
// specularColor, specularPower and opacity: the material of the side that is seen.
//@if TwoSided
//@if Mirrored
  bool frontFacing = !gl_FrontFacing;
//@else
  bool frontFacing = gl_FrontFacing;
//@end
//@end
//@if FragmentNormal
//@if CellFrame
  int frame = 2 * (gl_PrimitiveID + PrimitiveIDOffset);
  vec3 N = safeNormal(normalMatrix * texelFetch(radiometryCellFrames, frame).xyz);
//@else
  vec3 N = safeNormal(normalVCVSOutput);
//@end
//@if TwoSided
  N = frontFacing ? N : -N;
//@end
//@end
//@if Field
  vec3 field = vec3(0.0);
//@if FieldOfCells
//@if FieldOfBack
  int cellField = 2 * (gl_PrimitiveID + PrimitiveIDOffset);
//@if TwoSided
  cellField += frontFacing ? 0 : 1;
//@end
  field += texelFetch(radiometryField, cellField).rgb;
//@else
  field += texelFetch(radiometryField, gl_PrimitiveID + PrimitiveIDOffset).rgb;
//@end
//@end
//@if FieldOfPoints
  vec3 pointField = fieldVSOutput;
//@if FieldOfBack
//@if TwoSided
  pointField = frontFacing ? fieldVSOutput : fieldBackVSOutput;
//@end
//@end
  field += pointField;
//@end
  field *= fieldScale;
//@end
//@if FieldIsReflectance
  diffuseColor = field;
  ambientColor = ambientIntensity * field;
//@end
//@if Materials
  int materialOfCell =
    int(texelFetch(radiometryMaterialOfCell, gl_PrimitiveID + PrimitiveIDOffset).r);
  int material = 6 * materialOfCell;
//@if TwoSided
  material += frontFacing ? 0 : 3;
//@end
  vec4 materialDiffuse = texelFetch(radiometryMaterials, material);
//@if Lit
  diffuseColor = materialDiffuse.rgb;
  ambientColor = ambientIntensity * materialDiffuse.rgb;
//@end
//@if Specular
  specularColor = texelFetch(radiometryMaterials, material + 1).rgb;
  specularPower = materialDiffuse.a;
//@end
//@end
//@if ShowField
  vec3 color = field;
//@end
//@if FalseColor
//@if ScalarsOfPoints
  vec4 falseColor = colorOfScalar(scalarVSOutput);
//@else
//@if ColorsOfPoints
  vec4 falseColor = colorVSOutput;
//@else
  vec4 falseColor = vec4(diffuseColorUniform, 1.0);
//@end
//@end
//@if ColorsOfCells
  vec4 cellColor = texelFetch(radiometryCellColors, gl_PrimitiveID + PrimitiveIDOffset);
  falseColor = cellColor.a >= 0.0 ? cellColor : falseColor;
  falseColor = cellColor.a < -1.5 ? vec4(diffuseColorUniform, 1.0) : falseColor;
//@end
//@if BlockColors
  falseColor = OverridesColor ? vec4(diffuseColorUniform, 1.0) : falseColor;
//@end
//@if Opaque
  gl_FragData[0] = vec4(falseColor.rgb, 1.0);
//@else
  gl_FragData[0] = vec4(falseColor.rgb, falseColor.a * opacityUniform);
//@end
//@end
//@if ShowNormals
  gl_FragData[0] = vec4(viewToWorld * N, 1.0);
//@end
//@if Lit
//@if Ambient
  vec3 color = ambientColor * globalAmbient;
//@else
  vec3 color = vec3(0.0);
//@end
//@end
//@if Lights
//@if PerTriangle
  int shadingOfTriangle = gl_PrimitiveID + PrimitiveIDOffset;
  if (texelFetch(radiometryShading, shadingOfTriangle / 4)[shadingOfTriangle % 4] > 0.5)
  {
//@end
//@if PerVertex
//@if LightAmbient
  color += ambientColor * ambientLightVSOutput;
//@end
//@if TwoSided
  color += diffuseColor * (frontFacing ? diffuseFrontVSOutput : diffuseBackVSOutput);
//@if Specular
  color += specularColor * (frontFacing ? specularFrontVSOutput : specularBackVSOutput);
//@end
//@else
  color += diffuseColor * diffuseFrontVSOutput;
//@if Specular
  color += specularColor * specularFrontVSOutput;
//@end
//@end
//@end
//@if PerTriangle
  }
  else
  {
//@end
//@if FragmentNormal
//@if CellPosition
  vec3 P = MCLCMatrix * texelFetch(radiometryCellFrames, frame + 1).xyz;
//@end
//@if FragmentPosition
  vec3 P = positionVSOutput;
//@end
//@if Specular
//@if LocalViewer
  vec3 V = eyeLC - P;
  V *= inversesqrt(max(dot(V, V), 1e-37));
//@else
  vec3 V = vec3(0.0, 0.0, 1.0);
//@end
//@end
//@if Visibility
//@if VisibilityOfFront
  visibilityKnown = frontFacing;
//@end
//@if VisibilityOfCells
  visibilityFirst = visibilityTexels.y * (gl_PrimitiveID + PrimitiveIDOffset);
//@if VisibilityOfBack
  visibilityFirst += frontFacing ? 0 : visibilityTexels.x;
//@end
//@end
//@if VisibilityOfPoints
  visibilityOfPoint[0] = visibility0VSOutput;
//@if VisibilityOfBack
  visibilityOfPoint[0] = frontFacing ? visibility0VSOutput : visibilityBack0VSOutput;
//@end
//@end
//@if VisibilityOfPoints2
  visibilityOfPoint[1] = visibility1VSOutput;
//@if VisibilityOfBack
  visibilityOfPoint[1] = frontFacing ? visibility1VSOutput : visibilityBack1VSOutput;
//@end
//@end
//@if VisibilityOfPoints3
  visibilityOfPoint[2] = visibility2VSOutput;
//@end
//@if VisibilityOfPoints4
  visibilityOfPoint[3] = visibility3VSOutput;
//@end
//@end
  LightSums sums = sumLights(N
//@if Finite
    , P
//@end
//@if Specular
    , V, specularPower
//@end
    );
//@if Diffuse
  color += diffuseColor * sums.diffuse;
//@end
//@if LightAmbient
  color += ambientColor * sums.ambient;
//@end
//@if Specular
  color += specularColor * sums.specular;
//@end
//@end
//@end
//@if PerTriangle
  }
//@end
//@if MaterialEmission
  color += texelFetch(radiometryMaterials, material + 2).rgb;
//@end
//@if Emission
//@if TwoSided
  color += frontFacing ? emission : backEmission;
//@else
  color += emission;
//@end
//@end
//@if Lit
//@if Opaque
  gl_FragData[0] = vec4(color, 1.0);
//@else
  gl_FragData[0] = vec4(color, opacity);
//@end
//@end
//@if ShowField
//@if Opaque
  gl_FragData[0] = vec4(color, 1.0);
//@else
  gl_FragData[0] = vec4(color, opacity);
//@end
//@end
//@if Edges
  gl_FragData[0].rgb = mix(gl_FragData[0].rgb, edgeColor, emix);
//@end
