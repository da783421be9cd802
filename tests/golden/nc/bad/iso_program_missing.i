; run: failed line 3: program TNC:\nc_prog\UP1.I does not exist
%BAD G71 *
N10 %UP1 *
N99999999 %BAD G71 *
