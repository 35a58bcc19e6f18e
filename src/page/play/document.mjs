// What each page of the simulator begins with.

/** `policy`: rules of its content. `body`: the element. */
export const documentOf = ({ title, policy, style, body }) => `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="${policy.join('; ')}">
<link rel="icon" href="data:,">
<title>${title}</title>
<style>${style}</style>
</head>
${body}
</html>
`;
