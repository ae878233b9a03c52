//! How many float operations shading spends on a pair of sample and light, counted in the shader itself.

use naga::valid::{Capabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator};
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, MathFunction, Module, ScalarKind,
    ShaderStage, Statement, TypeInner, UnaryOperator,
};
use vsgl_core::plan::Plan;
use vsgl_core::{Error, Result};

/// Additions, multiplications, divisions, roots, comparisons for a choice and so on in the body of the loop over lights,
/// each one operation for each component. Branches that the plan's constants decide are left out; others count in full.
pub(crate) fn per_light(plan: &Plan) -> Result<u64> {
    let wrong = |problem: String| Error::setting("shader", problem, "report it");
    let ids = vsgl_wgpu::kernels(plan);
    let id = ids
        .iter()
        .find(|id| id.entry == "vsgls")
        .ok_or_else(|| wrong("no kernel that shades by clusters".into()))?;
    let module = naga::front::wgsl::parse_str(&vsgl_wgpu::link(&[id.file]))
        .map_err(|e| wrong(e.to_string()))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|e| wrong(e.to_string()))?;
    let values = id
        .constants
        .iter()
        .map(|&(n, v)| (n.to_owned(), v))
        .collect();
    let entry = Some((ShaderStage::Compute, id.entry));
    let (module, info) =
        naga::back::pipeline_constants::process_overrides(&module, &info, entry, &values)
            .map_err(|e| wrong(e.to_string()))?;
    let index = module.entry_points.iter().position(|e| e.name == id.entry);
    let index = index.ok_or_else(|| wrong("the entry is gone".into()))?;
    let counter = Counter {
        module: &module,
        info: &info,
    };
    let function = &module.entry_points[index].function;
    let body = first_loop(&function.body).ok_or_else(|| wrong("no loop over lights".into()))?;
    Ok(counter.block(function, info.get_entry_point(index), body))
}

fn first_loop(block: &Block) -> Option<&Block> {
    block.iter().find_map(|statement| match statement {
        Statement::Loop { body, .. } => Some(body),
        Statement::If { accept, reject, .. } => first_loop(accept).or_else(|| first_loop(reject)),
        Statement::Block(inner) => first_loop(inner),
        _ => None,
    })
}

struct Counter<'a> {
    module: &'a Module,
    info: &'a ModuleInfo,
}

impl Counter<'_> {
    fn block(&self, function: &Function, info: &FunctionInfo, block: &Block) -> u64 {
        let inner = |block: &Block| self.block(function, info, block);
        let statement = |statement: &Statement| match statement {
            Statement::Emit(range) => range
                .clone()
                .map(|e| self.expression(function, info, e))
                .sum(),
            Statement::Block(block) => inner(block),
            Statement::If {
                condition,
                accept,
                reject,
            } => match function.expressions[*condition] {
                Expression::Literal(Literal::Bool(true)) => inner(accept),
                Expression::Literal(Literal::Bool(false)) => inner(reject),
                _ => inner(accept) + inner(reject),
            },
            Statement::Loop {
                body, continuing, ..
            } => inner(body) + inner(continuing),
            Statement::Call {
                function: called, ..
            } => {
                let function = &self.module.functions[*called];
                self.block(function, &self.info[*called], &function.body)
            }
            _ => 0,
        };
        block.iter().map(statement).sum()
    }

    fn expression(
        &self,
        function: &Function,
        info: &FunctionInfo,
        handle: Handle<Expression>,
    ) -> u64 {
        let floats = |handle: Handle<Expression>| match *info[handle]
            .ty
            .inner_with(&self.module.types)
        {
            TypeInner::Scalar(scalar) if scalar.kind == ScalarKind::Float => 1,
            TypeInner::Vector { size, scalar } if scalar.kind == ScalarKind::Float => size as u64,
            _ => 0,
        };
        match function.expressions[handle] {
            Expression::Binary { op, left, right } => match op {
                BinaryOperator::Add
                | BinaryOperator::Subtract
                | BinaryOperator::Multiply
                | BinaryOperator::Divide => floats(handle),
                // Comparisons give no float, but cost one for each that they compare.
                _ => floats(left).min(floats(right)),
            },
            Expression::Unary {
                op: UnaryOperator::Negate,
                ..
            } => floats(handle),
            Expression::Select { .. } => floats(handle),
            Expression::Math { fun, arg, .. } => match fun {
                MathFunction::Dot => 2 * floats(arg) - 1,
                MathFunction::Cross => 9,
                MathFunction::Clamp => 2 * floats(handle),
                _ => floats(handle),
            },
            _ => 0,
        }
    }
}
