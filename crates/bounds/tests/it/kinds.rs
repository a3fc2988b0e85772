//! The kinds that naga's IR has, by class. Each list is an exhaustive match as well: a kind that a new version of naga brings does
//! not compile until it is listed, and then has to be reached by a test or be named with a reason.

use naga::{
    AddressSpace, ArraySize, AtomicFunction, BinaryOperator, BuiltIn, CollectiveOperation, DerivativeAxis,
    DerivativeControl, Direction, Expression, GatherMode, ImageClass, ImageDimension, ImageQuery,
    Interpolation, Literal, MathFunction, RelationalFunction, SampleLevel, Sampling, ScalarKind, Statement,
    StorageFormat, SubgroupOperation, SwitchValue, TypeInner, UnaryOperator,
};

/// An enum of the IR whose variants are kinds.
pub(crate) trait Kinds {
    /// What they are kinds of.
    const CLASS: &'static str;
    /// All of them.
    const ALL: &'static [&'static str];
    /// The kind of this one.
    fn kind(&self) -> &'static str;
}

macro_rules! kinds {
    ($($class:literal $name:ident [$($variant:ident)*];)*) => {
        $(impl Kinds for $name {
            const CLASS: &'static str = $class;
            const ALL: &'static [&'static str] = &[$(stringify!($variant)),*];
            fn kind(&self) -> &'static str {
                match self { $($name::$variant { .. } => stringify!($variant),)* }
            }
        })*
        /// Every class with its kinds.
        pub(crate) const CLASSES: &[(&str, &[&str])] = &[$(($class, $name::ALL)),*];
    };
}

kinds! {
    "expression" Expression [Literal Constant Override ZeroValue Compose Access AccessIndex Splat Swizzle
        FunctionArgument GlobalVariable LocalVariable Load ImageSample ImageLoad ImageQuery Unary Binary Select
        Derivative Relational Math As CallResult AtomicResult WorkGroupUniformLoadResult ArrayLength
        RayQueryVertexPositions RayQueryProceedResult RayQueryGetIntersection SubgroupBallotResult
        SubgroupOperationResult CooperativeLoad CooperativeMultiplyAdd];
    "statement" Statement [Emit Block If Switch Loop Break Continue Return Kill ControlBarrier MemoryBarrier Store
        ImageStore Atomic ImageAtomic WorkGroupUniformLoad Call RayQuery RayPipelineFunction SubgroupBallot
        SubgroupGather SubgroupCollectiveOperation CooperativeStore];
    "math" MathFunction [Abs Min Max Clamp Saturate Cos Cosh Sin Sinh Tan Tanh Acos Asin Atan Atan2 Asinh Acosh
        Atanh Radians Degrees Ceil Floor Round Fract Trunc Modf Frexp Ldexp Exp Exp2 Log Log2 Pow Dot Dot4I8Packed
        Dot4U8Packed Outer Cross Distance Length Normalize FaceForward Reflect Refract Sign Fma Mix Step SmoothStep
        Sqrt InverseSqrt Inverse Transpose Determinant QuantizeToF16 CountTrailingZeros CountLeadingZeros
        CountOneBits ReverseBits ExtractBits InsertBits FirstTrailingBit FirstLeadingBit Pack4x8snorm Pack4x8unorm
        Pack2x16snorm Pack2x16unorm Pack2x16float Pack4xI8 Pack4xU8 Pack4xI8Clamp Pack4xU8Clamp Unpack4x8snorm
        Unpack4x8unorm Unpack2x16snorm Unpack2x16unorm Unpack2x16float Unpack4xI8 Unpack4xU8];
    "binary" BinaryOperator [Add Subtract Multiply Divide Modulo Equal NotEqual Less LessEqual Greater GreaterEqual
        And ExclusiveOr InclusiveOr LogicalAnd LogicalOr ShiftLeft ShiftRight];
    "unary" UnaryOperator [Negate LogicalNot BitwiseNot];
    "relational" RelationalFunction [All Any IsNan IsInf];
    "atomic" AtomicFunction [Add Subtract And ExclusiveOr InclusiveOr Min Max Exchange];
    "derivative axis" DerivativeAxis [X Y Width];
    "derivative control" DerivativeControl [Coarse Fine None];
    "level" SampleLevel [Auto Zero Exact Bias Gradient];
    "query" ImageQuery [Size NumLevels NumLayers NumSamples];
    "gather" GatherMode [BroadcastFirst Broadcast Shuffle ShuffleDown ShuffleUp ShuffleXor QuadBroadcast QuadSwap];
    "direction" Direction [X Y Diagonal];
    "collective" CollectiveOperation [Reduce InclusiveScan ExclusiveScan];
    "subgroup" SubgroupOperation [All Any Add Mul Min Max And Or Xor];
    "type" TypeInner [Scalar Vector Matrix CooperativeMatrix Atomic Pointer ValuePointer Array Struct Image Sampler
        AccelerationStructure RayQuery BindingArray];
    "scalar" ScalarKind [Sint Uint Float Bool AbstractInt AbstractFloat];
    "literal" Literal [F64 F32 F16 U16 I16 U32 I32 U64 I64 Bool AbstractInt AbstractFloat];
    "array size" ArraySize [Constant Pending Dynamic];
    "address space" AddressSpace [Function Private WorkGroup Uniform Storage Handle Immediate TaskPayload
        RayPayload IncomingRayPayload];
    "image dimension" ImageDimension [D1 D2 D3 Cube];
    "image class" ImageClass [Sampled Depth External Storage];
    "storage format" StorageFormat [R8Unorm R8Snorm R8Uint R8Sint R16Uint R16Sint R16Float Rg8Unorm Rg8Snorm
        Rg8Uint Rg8Sint R32Uint R32Sint R32Float Rg16Uint Rg16Sint Rg16Float Rgba8Unorm Rgba8Snorm Rgba8Uint
        Rgba8Sint Bgra8Unorm Rgb10a2Uint Rgb10a2Unorm Rg11b10Ufloat R64Uint Rg32Uint Rg32Sint Rg32Float Rgba16Uint
        Rgba16Sint Rgba16Float Rgba32Uint Rgba32Sint Rgba32Float R16Unorm R16Snorm Rg16Unorm Rg16Snorm Rgba16Unorm
        Rgba16Snorm];
    "built-in" BuiltIn [PrimitiveIndex Position ViewIndex BaseInstance BaseVertex ClipDistances CullDistance
        InstanceIndex PointSize VertexIndex DrawIndex FragDepth PointCoord FrontFacing Barycentric SampleIndex
        SampleMask GlobalInvocationId LocalInvocationId LocalInvocationIndex WorkGroupId WorkGroupSize
        NumWorkGroups NumSubgroups SubgroupId SubgroupSize SubgroupInvocationId MeshTaskSize CullPrimitive
        PointIndex LineIndices TriangleIndices VertexCount Vertices PrimitiveCount Primitives RayInvocationId
        NumRayInvocations InstanceCustomData GeometryIndex WorldRayOrigin WorldRayDirection ObjectRayOrigin
        ObjectRayDirection RayTmin RayTCurrentMax ObjectToWorld WorldToObject HitKind];
    "interpolation" Interpolation [Perspective Linear Flat PerVertex];
    "sampling" Sampling [Center Centroid Sample First Either];
    "switch" SwitchValue [I32 U32 Default];
}
