// Which item an invocation has, and which number a workgroup, in a grid of two dimensions.

fn item_index(invocation: vec3<u32>, groups: vec3<u32>) -> u32 {
    return invocation.y * (groups.x * INVOCATIONS) + invocation.x;
}

fn group_index(group: vec3<u32>, groups: vec3<u32>) -> u32 {
    return group.y * groups.x + group.x;
}
